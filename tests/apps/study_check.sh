#!/usr/bin/env bash
# study_check.sh: tests the scripts of apps/study, and that the tables of apps/study/README.md are those of its data.
# Exit code 77 (skipped) without numpy. WEDGE_PYTHON: the interpreter, else that of PATH or that of the system.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
for python in ${WEDGE_PYTHON:-python3 /usr/bin/python3} ""; do
  [ -n "$python" ] || { echo "no Python with numpy: apt-get install python3-numpy"; exit 77; }
  ! "$python" -B -c "import numpy" 2>/dev/null || break
done
"$python" -B "$top/tests/apps/test_kept.py"
"$python" -B "$top/tests/apps/test_rule.py"
"$python" -B "$top/apps/study/tables.py" --check
