#!/usr/bin/env bash
# Sets up a machine: system packages where it may, a virtual environment in $1, the browser parts in node_modules/.
set -euo pipefail
venv=${1:?usage: setup.sh VENV}

say() { printf '%s\n' "setup: $*" >&2; }

python=
for candidate in "${PYTHON:-python3}" python3.14 python3.13 python3.12 python3.11; do
  if "$candidate" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
    python=$candidate
    break
  fi
done
if [ -z "$python" ]; then
  say "Python 3.11 or newer is needed; install it, or name it: make PYTHON=/path/to/python3 ..."
  exit 1
fi

# OpenGL draws the pictures, Chromium runs the browser tests. Both come from the system.
missing=()
"$python" -c 'import ctypes; ctypes.CDLL("libEGL.so.1")' 2>/dev/null || missing+=(libegl1 libgl1)
command -v chromium >/dev/null || command -v google-chrome >/dev/null || missing+=(chromium)
if [ ${#missing[@]} -gt 0 ]; then
  install="apt-get update -qq && apt-get install -y -qq --no-install-recommends ${missing[*]}"
  if command -v apt-get >/dev/null && [ "$(id -u)" = 0 ]; then
    say "installing ${missing[*]}"
    DEBIAN_FRONTEND=noninteractive bash -c "$install" >/dev/null
  elif command -v apt-get >/dev/null && sudo -n true 2>/dev/null; then
    say "installing ${missing[*]}"
    sudo DEBIAN_FRONTEND=noninteractive bash -c "$install" >/dev/null
  else
    say "missing on this system: ${missing[*]} (names as in Debian). Without them there are no pictures or no browser tests."
  fi
fi

if ! "$python" -m venv "$venv" 2>/dev/null; then
  say "$python cannot make a virtual environment; on Debian: apt-get install python3-venv"
  exit 1
fi
say "installing the locked Python packages into $venv"
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements.txt
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation -e .

say "installing the locked browser parts into node_modules"
if ! PATH="$PWD/$venv/bin:$PATH" npm ci --silent --no-audit --no-fund; then
  say "the browser parts could not be installed; without them the built site has neither playground nor search"
  [ -z "${CI:-}" ] || exit 1
fi

say "installing the engine of the browser parts as a Python package into $venv/parity"
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check --require-hashes --no-deps --upgrade \
  --target "$venv/parity" -r requirements-parity.txt
