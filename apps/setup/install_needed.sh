# install_needed.sh: to be sourced; installs the Debian packages that building wedge needs and that are missing.

# have_package NAME...: whether one of these packages is installed.
have_package() {
  local name
  for name in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null)" = installed ] && return 0
  done
  return 1
}

# cmake_is_new_enough: whether there is a CMake of version 3.22 or later.
cmake_is_new_enough() {
  command -v cmake >/dev/null &&
    [ "$(printf '3.22\n%s\n' "$(cmake --version | sed -n '1s/[^0-9]*\([0-9.]*\).*/\1/p')" | sort -V | head -n 1)" = 3.22 ]
}

# as_root COMMAND...: runs it as root, by sudo when we are not.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo env DEBIAN_FRONTEND=noninteractive "$@"
  else
    echo "error: installing packages needs root: install sudo, or run this as root" >&2
    return 1
  fi
}

# install_needed [NAME...]: what wedge needs, and these packages. Ends the script with one clear line when a package
# cannot be had.
install_needed() {
  local missing=() name log
  if ! command -v dpkg-query >/dev/null; then
    for name in c++ cmake; do
      command -v $name >/dev/null || { echo "error: $name is missing, and this is no Debian to install it on" >&2; exit 1; }
    done
    return 0
  fi
  if ! command -v g++ >/dev/null; then
    if command -v clang++ >/dev/null; then have_package libomp-dev || missing+=(libomp-dev); else missing+=(g++); fi
  fi
  cmake_is_new_enough || missing+=(cmake)
  command -v make >/dev/null || command -v ninja >/dev/null || missing+=(make)
  for name in libeigen3-dev libhdf5-dev libxxhash-dev catch2 libtomlplusplus-dev nlohmann-json3-dev libcli11-dev "$@"; do
    have_package "$name" || missing+=("$name")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  echo "Installing these Debian packages: ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  log=$(mktemp)
  as_root true || exit 1
  as_root apt-get update >"$log" 2>&1 || true  # without a network the packages may still be in the cache
  for name in "${missing[@]}"; do
    as_root apt-get install -y --no-install-recommends "$name" >"$log" 2>&1 && continue
    echo "error: the package $name cannot be had: $(grep '^E:' "$log" | tail -n 1 | cut -c 4-)" >&2
    rm -f "$log"
    exit 1
  done
  rm -f "$log"
  cmake_is_new_enough || { echo "error: CMake 3.22 or later is needed, this system has an older one" >&2; exit 1; }
}

# generator: what CMake shall write for: Ninja where there is one.
generator() {
  if command -v ninja >/dev/null; then echo Ninja; else echo "Unix Makefiles"; fi
}

# configure FOLDER OPTION...: makes a build folder; one made for another generator or another place is made anew.
configure() {
  local folder=$1 cache=$1/CMakeCache.txt
  shift
  if [ -f "$cache" ]; then
    if ! grep -qxF "CMAKE_GENERATOR:INTERNAL=$(generator)" "$cache" ||
      ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" "$cache"; then
      rm -rf "$folder"
    fi
  fi
  cmake -S . -B "$folder" -G "$(generator)" "$@" || exit 1
}
