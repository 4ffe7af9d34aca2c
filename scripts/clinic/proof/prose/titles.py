"""Law 5, what a remedy does: its title names attributes, values and code that its edits change."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

from clinic.engine.variant import Variant, variants
from clinic.proof.evidence import Evidence
from clinic.record.case import Case
from clinic.record.problem import Problem, listed

ACTS = (
    (r"damp", "damping kv dampratio solref"),
    (r"stiff|soft", "stiffness solref solimp kp impratio timeconst"),
    (r"armature", "armature"),
    (r"heav|lighter|weigh|\bmass", "mass density gravcomp gravity"),
    (r"thick|\bthin", "size fromto"),
    (r"friction|rough|slipper", "friction condim cone impratio noslip"),
    (r"timestep|\bstep at\b", "timestep"),
    (r"integrat|runge|implicit|\beuler\b", "integrator"),
    (r"\bgain", "kp kv gear gainprm biasprm dampratio"),
    (r"torque|harder|strong", "gear kp gainprm forcerange ctrlrange"),
    (r"\baxis|\baxes", "axis xyaxes zaxis euler quat axisangle"),
    (r"\bmask|\bbit\b", "contype conaffinity"),
    (r"\blimit|\brange", "range limit qpos ref"),
    (r"priorit", "priority"),
    (r"\bmargin", "margin gap"),
    (r"gravity", "gravity gravcomp"),
    (r"\bcolou?r|paint", "rgba material"),
)
"""What titles say, and the names or parts of names of attributes of which one then is changed."""
VALUES = (("radian", "degree"), ("enable", "disable"), ("RK4", "implicitfast", "discrete"), ("elliptic", "pyramidal"))
SWITCHED = {"disable": r"\boff\b|\bdisable", "enable": r"\bon\b|\benable|\blet\b"}
CODE_NAME = re.compile(r"\b[A-Za-z]+(?:[._][A-Za-z]+)+\b")


def performed(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, acts. A title says of attributes, values and functions no other than those that the edits change."""
    broken, *others = variants(case)
    for variant in others:
        where, title = (*variant.where, "title"), variant.title
        for name in CODE_NAME.findall(title):
            if not any(name in edit.replace for edit in variant.edits):
                yield case.problem(where, name, "code that its edits write", "correct the title or the edits", name)
        written = {edit.replace for edit in variant.edits}
        for group in VALUES:
            told = [value for value in group if re.search(SWITCHED.get(value, rf"\b{value}"), title, re.IGNORECASE)]
            made = [value for value in group if any(f'"{value}"' in text for text in written)]
            if told and made and not set(told) & set(made):
                yield case.problem(where, title, f"a title that says {listed(made)}", "correct the title or the edits")
        if case.record.run is None:
            continue
        changed = changed_attributes(broken, variant)
        for words, attributes in ACTS:
            found = re.search(words, title, re.IGNORECASE)
            if found and changed and not any(part in name for part in attributes.split() for name in changed):
                wanted = f"what its edits change: {listed(sorted(changed))}"
                yield case.problem(where, found[0], wanted, "correct the title or the edits", found[0])


def changed_attributes(broken: Variant, variant: Variant) -> set[str]:
    """The names of the attributes that a variant writes, removes or gives another value."""
    before, after = (Counter(re.findall(r'(\w+)="([^"]*)"', each.text)) for each in (broken, variant))
    return {name for name, _ in (before - after) + (after - before)}
