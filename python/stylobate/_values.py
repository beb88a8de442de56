"""What notebooks show of the plain values that answers consist of. Their classes are those of the C++ library."""

from . import _core
from ._view import View, chart, interval, line, percent, words

STATES = ("stood", "rocked", "slid", "collapsed", "invalid")
# what is shown of the outcome of a realization
TOLD = ("frequency_hz", "pga_m_s2", "fallen_blocks", "peak_top_displacement_m", "residual_top_displacement_m",
        "total_sliding_m", "max_relative_rotation_rad", "max_twist_rad", "end_time_s", "step_s")
_UNITS = (("_m_s2", "m/s²"), ("_m_s", "m/s"), ("_hz", "Hz"), ("_bytes", "bytes"), ("_rad", "rad"), ("_m", "m"),
          ("_s", "s"))


def named(name):
    """The name of a field in words, with its unit: "pga [m/s²]"."""
    for ending, unit in _UNITS:
        if name.endswith(ending):
            return f"{name[:-len(ending)].replace('_', ' ')} [{unit}]"
    return name.replace("_", " ")


def fields(thing):
    """Names and values of the attributes of a value of C++, in words."""
    names = [name for name, member in vars(type(thing)).items() if isinstance(member, property)]
    return [(named(name), getattr(thing, name)) for name in names]


def shares_text(share):
    """ "12 of 64: 18.8 % (10.8 to 29.6)"."""
    if share.trials == 0:
        return "no realization"
    return f"{share.count} of {share.trials}: {percent(share.probability, share.lower, share.upper)}"


def _share(share):
    return View(f"{shares_text(share)}, 95 % interval").facts(fields(share))


def _progress(progress):
    return View(f"{progress.done} of {progress.total} realizations").facts(fields(progress))


def _intensity(intensity):
    return View(f"PGA {words(intensity.pga_m_s2)} m/s², PGV {words(intensity.pgv_m_s)} m/s").facts(fields(intensity))


def _record(record):
    shown = View(f"Record of {words(record.duration_s)} s: {record.title or record.file}")
    shown.facts([("file", record.file), ("format", record.format), ("component", record.component),
                 ("samples", len(record.acceleration_m_s2)), ("time step [s]", record.dt_s)])
    try:
        shown.facts(fields(record.intensity()))
    except _core.InputError as error:  # all samples are equal
        shown.note(str(error))
    acceleration = record.acceleration_m_s2
    time = [i * record.dt_s for i in range(len(acceleration))]
    return shown.figure(chart("Acceleration of the record over time", "time [s]", "acceleration [m/s²]",
                              [line(time, acceleration)]))


def _weak_spot(spot):
    return View(spot.name.replace("_", " ")).note(spot.text).note(spot.remedy)


def _chosen(chosen):
    return View(f"{chosen.key} = {chosen.value}").note(chosen.reason)


def _trial(trial):
    return View(f"{trial.collapsed} of {trial.valid} collapsed in the trial").facts(fields(trial))


def _run_time(time):
    low, high = time.range_s
    return View(f"{'At most ' + words(high) if time.at_most else words(low) + ' to ' + words(high)} s").facts(fields(time))


def _pilot(pilot):
    return View(f"Finer numerics change the collapse probability by {-pilot.difference:+.4f} ± "
                f"{pilot.standard_error:.4f}").facts(fields(pilot))


def parameter_state(parameter):
    """ "determined", "effective" or "not determined"."""
    return "determined" if parameter.determined else "effective" if parameter.effective else "not determined"


def _parameter(parameter):
    shown = View(f"{parameter.key} = {interval(parameter.value, parameter.lower, parameter.upper)}, "
                 f"{parameter_state(parameter)}")
    return shown.facts([fact for fact in fields(parameter) if fact[0] != "note"]).note(parameter.note)


def _calibrated_run(run):
    return View(f"{run.run}: {run.calibrated - run.start:+.4g} nats by the calibration").facts(fields(run))


def _gain(gain):
    return View(f"{interval(gain.nats, gain.lower, gain.upper)} nats on motions that were left out, 95 % interval")


def add_parameters(shown, parameters):
    """A table of calibrated parameters, and a figure of their intervals over the start values."""
    shown.table(("key", "start", "value", "95 % interval", ""),
                ((p.key, p.start, p.value, (p.lower, p.upper) if p.determined or p.effective else None,
                  parameter_state(p)) for p in parameters))
    drawn = [p for p in parameters if p.start > 0 and (p.determined or p.effective)]
    if drawn:
        series = line(range(len(drawn)), [p.value / p.start for p in drawn], [p.lower / p.start for p in drawn],
                      [p.upper / p.start for p in drawn], kind="points")
        shown.figure(chart("Calibrated parameters over their start values", "", "value / start value", [series],
                           x_ticks=[p.key for p in drawn]))
    return shown


def _form(form):
    shown = View(f"Contact form {form.form}: score {form.score - form.start_score:+.4g} nats over the start study")
    add_parameters(shown, form.parameters)
    return shown.table(("run", "motion", "start [nat]", "calibrated [nat]"),
                       ((run.run, run.motion_id, run.start, run.calibrated) for run in form.runs))


def _cause(cause):
    size = "" if cause.size is None else f": {interval(cause.size, cause.lower, cause.upper)} {cause.unit}"
    return View(f"{cause.mechanism} at {cause.place}{size}").facts(fields(cause))


def _add(views):
    for cls, view in views.items():
        cls._view = view
        cls._repr_html_ = lambda self: self._view().html()


_add({
    _core.CalibratedForm: _form,
    _core.CalibratedParameter: _parameter,
    _core.CalibratedRun: _calibrated_run,
    _core.Cause: _cause,
    _core.ChosenKey: _chosen,
    _core.HeldOutGain: _gain,
    _core.Intensity: _intensity,
    _core.Pilot: _pilot,
    _core.Progress: _progress,
    _core.Record: _record,
    _core.RunTime: _run_time,
    _core.Share: _share,
    _core.Trial: _trial,
    _core.WeakSpot: _weak_spot,
})
