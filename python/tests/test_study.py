"""Studies: the same text and the same messages as the program's."""

import copy
import pathlib
import pickle
import tomllib

import numpy
import pytest

import stylobate
from conftest import INPUTS, program

FILES = sorted(file for file in INPUTS.glob("*.toml") if file.stem != "record")  # it needs a record


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_a_dictionary_is_the_study_of_its_file(file, monkeypatch):
    monkeypatch.chdir(INPUTS)
    study = stylobate.Study.from_toml(file)
    assert stylobate.Study(tomllib.loads(file.read_text())) == study
    assert stylobate.Study(tomllib.loads(study.text)) == study


def test_settings_are_those_of_the_program(folder, small_surface):
    before = small_surface.text
    small_surface.set("contact.friction", numpy.float64(0.7))
    small_surface.set("output.realizations", "none")
    small_surface.set("perturbation.friction", {"distribution": "normal", "cov": 0.1, "per": "joint"})
    assert small_surface.text != before
    program("run", INPUTS / "small_scale_column.toml", "-o", "a.h5", "--quiet",
            settings={"study.realizations": 1, "contact.friction": 0.7,
                      "surface.frequency_hz": {"from": 1.0, "to": 4.0, "count": 3, "spacing": "log"},
                      "surface.pga_m_s2": {"from": 4.0, "to": 12.0, "count": 2}, "output.realizations": "none",
                      "perturbation.friction": {"distribution": "normal", "cov": 0.1, "per": "joint"}})
    small_surface.set("study.realizations", 1)
    assert stylobate.Result("a.h5").study == small_surface


@pytest.mark.parametrize("key, value", [("contact.friction", -1.0), ("contact.fricton", 0.7),
                                        ("structure.drum_height_m", 1450.0), ("study.kind", "surfac"),
                                        ("surface.pga_m_s2.count", 0)])
def test_a_mistake_has_the_message_of_the_program(folder, key, value, small_surface):
    file = INPUTS / "small_scale_column.toml"
    said = program("run", file, "-o", "a.h5", settings={key: value}, status=2)
    with pytest.raises(stylobate.InputError) as by_file:
        stylobate.Study.from_toml(file, {key: value})
    assert f"stylobate: {by_file.value}\n" == said
    before = small_surface.text
    with pytest.raises(stylobate.InputError):
        small_surface.set(key, value)
    assert small_surface.text == before


def test_a_mistake_in_a_dictionary_names_its_key():
    with pytest.raises(stylobate.InputError, match=r"study\.kind = \"surfac\" is not allowed"):
        stylobate.Study({"study": {"kind": "surfac"}})
    with pytest.raises(stylobate.InputError, match="study is a str; a study has tables"):
        stylobate.Study({"study": "surface"})
    with pytest.raises(stylobate.InputError, match=r"contact\.friction is a object"):
        stylobate.Study({"contact": {"friction": object()}})
    with pytest.raises(stylobate.InputError, match="made from a dictionary"):
        stylobate.Study("column.toml")
    with pytest.raises(stylobate.InputError, match="3 is no name of a key"):
        stylobate.Study({3: {}})


def test_paths_and_texts_with_any_character():
    text = stylobate._toml.document({"excitation": {"file": pathlib.Path('a "b"\\c\n\u03c0'), "x": [1, 2.5, True]}})
    assert tomllib.loads(text) == {"excitation": {"file": 'a "b"\\c\n\u03c0', "x": [1, 2.5, True]}}


def test_describe_and_properties(small_surface):
    assert (small_surface.kind, small_surface.seed, small_surface.realizations) == ("surface", 1, 18)
    text = small_surface.describe()
    assert "7 drums" in text and "K_N" in text and "Realizations" in text and "The plane leaves out" in text
    assert repr(small_surface) == "<Study: surface, 18 realizations>"
    for copied in (copy.copy(small_surface), copy.deepcopy(small_surface), pickle.loads(pickle.dumps(small_surface))):
        assert copied == small_surface
        copied.set("study.seed", 2)
        assert copied != small_surface


def test_record_is_read_only_and_keeps_its_owner(folder):
    record = stylobate.Record.from_samples(numpy.sin(numpy.arange(2000) * 0.01 * 2 * numpy.pi), 0.01)
    samples = record.acceleration_m_s2
    assert samples.shape == (2000,) and not samples.flags.writeable and not samples.flags.owndata
    del record
    assert samples[25] == numpy.sin(25 * 0.01 * 2 * numpy.pi)
    with pytest.raises(ValueError):
        samples[0] = 1


def test_records_without_step_or_unit_or_with_a_wrong_shape(folder):
    numbers = "\n".join(f"{0.1 * i % 1:.3f}" for i in range(200))
    pathlib.Path("plain.txt").write_text(numbers + "\n")
    times = "\n".join(f"{0.01 * i:.2f} {0.1 * i % 1:.3f}" for i in range(200))
    pathlib.Path("no_unit.txt").write_text(times + "\n")
    for file in ("plain.txt", "no_unit.txt"):
        said = program("record", file, status=2)
        with pytest.raises(stylobate.InputError) as error:
            stylobate.Record.read(file)
        assert f"stylobate: {error.value}\n" == said
    for component in (None, ""):
        assert stylobate.Record.read("no_unit.txt", component, "m/s2").dt_s == pytest.approx(0.01)
    with pytest.raises(stylobate.InputError, match=r"acceleration_m_s2 has the shape \(3, 2\)"):
        stylobate.Record.from_samples(numpy.zeros((3, 2)), 0.01)
    with pytest.raises(stylobate.InputError, match="these are no numbers"):
        stylobate.Record.from_samples(["a", "b"], 0.01)
    with pytest.raises(stylobate.InputError, match="dt_s = 0"):
        stylobate.Record.from_samples(numpy.arange(20.0), 0)


def test_spectrum_of_a_sine_at_resonance():
    # after n cycles at resonance the amplitude is that of the steady state, a / (2 zeta), times 1 - exp(-2 pi zeta n)
    dt, zeta, cycles = 0.002, 0.05, 10
    time = numpy.arange(int(cycles / dt) + 1) * dt
    record = stylobate.Record.from_samples(numpy.sin(2 * numpy.pi * time), dt)
    (spectral,) = record.spectral_acceleration_m_s2([1.0], zeta)
    assert spectral == pytest.approx((1 - numpy.exp(-2 * numpy.pi * zeta * cycles)) / (2 * zeta), rel=0.02)
    assert record.intensity().pga_m_s2 == pytest.approx(1, rel=1e-4)
