#!/usr/bin/env bash
# python_check.sh TEST.py [MODULE...]: runs a test with the first Python that has these modules: WEDGE_PYTHON, else that of
# PATH or that of the system. Exit code 77 (skipped) without one.
set -euo pipefail
test=$1 modules=(unittest "${@:2}")
for python in ${WEDGE_PYTHON:-python3 /usr/bin/python3}; do
  ! "$python" -B -c "import $(IFS=,; echo "${modules[*]}")" 2>/dev/null || exec "$python" -B "$test"
done
echo "no Python with ${modules[*]}: apt-get install python3-${2:-minimal}"
exit 77
