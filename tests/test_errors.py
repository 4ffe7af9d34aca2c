"""The package's exceptions: each is the same on the other side of a worker, whatever its constructor takes."""

from __future__ import annotations

import importlib
import inspect
import pickle
import pkgutil

import clinic
import pytest
from clinic.commands.diagnosis_options import OptionError
from clinic.diagnosis.bench.faults import NoPlaceError
from clinic.diagnosis.engine import CompileError
from clinic.diagnosis.process import DiagnosisError
from clinic.diagnosis.source import SourceError
from clinic.diagnosis.start import StartError
from clinic.engine.mjcf import ModelError
from clinic.engine.quotation import QuotationError
from clinic.engine.render import RenderError
from clinic.engine.script import ScriptError
from clinic.engine.signals import SignalError
from clinic.engine.simulate import RunError
from clinic.engine.variant import EditError
from clinic.pages.text.prose import ProseError
from clinic.record.expression import ExpressionError
from clinic.record.problem import CaseError, MissingRequirementError, Problem
from clinic.record.units import UnitError
from clinic.work.parallel import ClusterError

EXAMPLES = [
    CaseError(
        [Problem("cases/b/case.yaml", 2, "run", "x", "y", "z"), Problem("cases/a/case.yaml", 1, "", "x", "y", "z")]
    ),
    ClusterError("no scheduler"),
    CompileError("XML Error"),
    DiagnosisError("no model"),
    EditError(2, 0),
    ExpressionError("a number"),
    MissingRequirementError("no Node"),
    ModelError(3, "a file", "none", "write it out"),
    NoPlaceError(),
    OptionError("--ctrl x"),
    ProseError("{{ x }}", "a field", "correct it"),
    QuotationError("no such element", "cube"),
    RenderError("no OpenGL"),
    RunError(("qpos", "elbow"), "x", "y", "z"),
    ScriptError("KeyError: 'x'", "mend it"),
    SignalError("bodi(x)", "a path", "write body(x)"),
    SourceError("model.xml", 3, "mismatched tag"),
    StartError("keyframe home: the model has none"),
    UnitError("m + s"),
]


@pytest.mark.parametrize("error", EXAMPLES, ids=lambda error: type(error).__name__)
def test_an_error_survives_the_way_between_processes(error: Exception) -> None:
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error)
    assert str(again) == str(error)
    assert vars(again) == vars(error)


def test_there_is_an_example_of_every_error() -> None:
    found = [found.name for found in pkgutil.walk_packages(clinic.__path__, "clinic.")]
    modules = [importlib.import_module(name) for name in found if not name.endswith("__main__")]
    kinds = {
        kind
        for module in modules
        for _, kind in inspect.getmembers(module, inspect.isclass)
        if issubclass(kind, Exception) and kind.__module__.startswith("clinic.")
    }
    assert kinds == {type(error) for error in EXAMPLES}
