#pragma once
/// Ensembles of rocking and sliding multi-drum columns, for programs in C++20: all of the library.
///
///   namespace sb = stylobate::api;
///   sb::Study study = sb::Study::from_file("column.toml");
///   sb::Result result = sb::run(sb::Experiment(study));
///
/// SI units throughout; the unit is a part of each name. docs/library.md describes how to build against it.

#include "stylobate/answer.hpp"
#include "stylobate/calibration.hpp"
#include "stylobate/check.hpp"
#include "stylobate/compare.hpp"
#include "stylobate/diagnosis.hpp"
#include "stylobate/error.hpp"
#include "stylobate/experiment.hpp"
#include "stylobate/figure.hpp"
#include "stylobate/fragility.hpp"
#include "stylobate/past.hpp"
#include "stylobate/record.hpp"
#include "stylobate/report.hpp"
#include "stylobate/result.hpp"
#include "stylobate/risk.hpp"
#include "stylobate/run.hpp"
#include "stylobate/study.hpp"
#include "stylobate/surface.hpp"
#include "stylobate/trajectory.hpp"
