#!/usr/bin/env bash
# run.sh FILE: a file of tests under pytest. Status 77, skipped, where the interpreter has no NumPy or pytest.
"$PYTHON" -c 'import numpy, pytest' || exit 77
exec "$PYTHON" -m pytest -q -p no:cacheprovider "$@"
