"""What is wrong with a reader's model, proved on it: an edit that makes the measured symptom go away names the cause.

All but `native` and `process` needs nothing but Python's standard library, so that it runs in a browser too.

source, edit            the model's text with places; changes of it
engine, native          what is asked of a physics engine; MuJoCo's Python binding as one
simulation, probes      a compiled model, and what is done to it so that a fault shows
reader_model            the text beside what was compiled of it, and every edited copy that was tried
rules, suspect, judge   what may be wrong; whether it is
diagnose, finding       all of it in turn, and what is said
"""
