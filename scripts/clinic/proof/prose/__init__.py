"""Law 5 for numbers and formulas; `prose_laws.py` has the rest."""
