"""How good the rules are, measured: on healthy models of other people, and on faults planted in them.

healthy   models that nobody calls broken, a third of them held out
faults    what is planted: a kind of fault is a function in a module of `faults`
behaviour what a model does when it is let go, pushed, driven and pressed
harm      what a planted fault does to the model, measured without the rules
trial     one plant, or one healthy model, diagnosed
table     all of it, by rule and by kind of fault
lock      what was measured, kept in a file, and the law that it gives
"""
