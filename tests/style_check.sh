#!/usr/bin/env bash
# style_check.sh format | tidy BUILD_FOLDER: whether all C++ files are formatted as .clang-format says; whether clang-tidy
# finds nothing in core, kernels, io and apps that .clang-tidy forbids (a quarter of an hour). Exit code 77 (skipped)
# where the tool is missing or of another version, which would format or judge differently.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
version=14  # Debian 12's

# tool NAME: its name with the version, or without where it is of that version.
tool() {
  local name
  for name in "$1-$version" "$1"; do
    ! "$name" --version 2>/dev/null | grep -q "version $version\." || { echo "$name"; return; }
  done
  echo "skipped: $1 $version is not installed" >&2
  exit 77
}

case "$#${1:-}" in
  1format)
    format=$(tool clang-format)
    git ls-files '*.cpp' '*.hpp' | xargs "$format" --dry-run -Werror ;;
  2tidy)
    tidy=$(tool clang-tidy)
    git ls-files 'core/*.cpp' 'kernels/*.cpp' 'io/*.cpp' 'apps/*.cpp' |
      xargs -P "$(nproc)" -n 1 "$tidy" -p "$2" --quiet --extra-arg=-Wno-unknown-warning-option 2>/dev/null ;;
  *) echo "usage: bash tests/style_check.sh format | tidy BUILD_FOLDER" >&2; exit 2 ;;
esac
