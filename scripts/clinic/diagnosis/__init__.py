"""What is wrong with a reader's model, proved on it: an edit that makes the measured symptom go away names the cause.

All but `native`, `given`, `process`, `symptom` and `bench` needs nothing but Python's standard library, so that it runs
in a browser too.

texts, source, edit     the model's texts; their elements with places; changes of them
engine, native, browser what is asked of a physics engine; MuJoCo's Python binding as one, its WebAssembly as another
simulation, probes      a compiled model, and what is done to it so that a fault shows
reader_model            the text beside what was compiled of it, and every edited copy that was tried
rules, suspect, judge   what may be wrong; whether it is
errors, stand_ins       a model that does not compile, mended; what stands in for files that are not there
diagnose, finding       all of it in turn, and what is said
ignores                 the comments in a model that silence a rule
process                 a diagnosis in a process of its own
given                   the model that a program gives beside its text, where it has changed numbers of it
symptom                 what the page of a symptom measures, on a reader's model
bench                   how good the rules are, measured
"""
