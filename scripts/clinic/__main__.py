"""`python -m clinic` is the command `clinic`."""

from clinic.commands.cli import main

main()
