/// Uses the installed libraries as an engineer's own program would: a study file in, an estimate out.

#include "ensemble/engine/executor.hpp"
#include "ensemble/numerics/interval.hpp"
#include "io/study/study_file.hpp"

#include <cstdio>

using namespace stylobate;

int main(int argc, char** argv)
{
    if (argc != 2)
        return 2;
    const Study study =
        read_study(argv[1], {"study.realizations=4", "surface.frequency_hz.count=1", "surface.frequency_hz.to=0.5",
                             "surface.pga_m_s2.count=1", "surface.pga_m_s2.from=12.0"});
    RunPlan plan;
    plan.total = study.total();
    plan.sink = [](const Realization&, const Outcome&) {};
    Observer observer;
    const Progress progress = run_ensemble(Experiment(study), {best_isa(), 1}, plan, observer);
    const BinomialInterval interval = jeffreys(progress.done, progress.collapsed, 0.95);
    std::printf("%llu of %llu collapsed, %.3f to %.3f\n", static_cast<unsigned long long>(progress.collapsed),
                static_cast<unsigned long long>(progress.done), interval.lower, interval.upper);
    // at 12 m/s2 and 0.5 Hz, three times what overturns the stack, all of them fall
    return progress.done == 4 && progress.collapsed == 4 ? 0 : 1;
}
