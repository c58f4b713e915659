# SPDX-License-Identifier: BSD-3-Clause
# What the scripts at the top of the repository share: packages, the workspace in build/, building with one lock.
# shellcheck shell=bash disable=SC2119,SC2120

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
build=$root/build
ws=$build/ws

say() { printf '%s\n' "$*" >&2; }
die() { say "$(basename "$0"): $*"; exit 1; }

# A python3 from elsewhere (pyenv, conda) lacks catkin_pkg, and CMake takes the first one in PATH.
use_system_tools() {
  export PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8
  export CCACHE_BASEDIR=$root  # clones of one repository share what ccache knows
  if [ -f /opt/ros/noetic/setup.bash ]; then
    set +u
    # shellcheck disable=SC1091
    . /opt/ros/noetic/setup.bash
    set -u
  fi
}

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

# missing_packages [PACKAGE...]: what of packages.apt and of these is not installed.
missing_packages() {
  comm -23 <({ sed 's/#.*//; s/ //g; /^$/d' "$root/packages.apt"; printf '%s\n' "$@" | sed '/^$/d'; } | sort -u) \
           <(dpkg-query -W -f='${db:Status-Abbrev}${Package}\n' | sed -n 's/^ii *//p' | sort -u)
}

# install_packages [PACKAGE...]: what is missing of packages.apt and of these; nothing where all is there.
install_packages() {
  local missing
  if [ -d /opt/ros/noetic ]; then return; fi  # Ubuntu has other names: rosdep knows them from the package.xml files
  command -v dpkg-query >/dev/null || die "no dpkg here; install by hand what packages.apt names"
  mapfile -t missing < <(missing_packages "$@")
  if [ ${#missing[@]} = 0 ]; then return; fi
  say "Installing ${#missing[@]} packages of Debian: ${missing[*]}"
  mkdir -p "$build"
  if ! { as_root apt-get -o Acquire::Retries=3 update &&
         as_root env DEBIAN_FRONTEND=noninteractive apt-get -o Acquire::Retries=3 install -y --no-install-recommends "${missing[@]}"; } \
       >"$build/packages.log" 2>&1 </dev/null; then
    tail -20 "$build/packages.log" >&2
    die "packages could not be installed (all of it: build/packages.log)"
  fi
}

# A workspace inside the repository would find every package again and again but for the CATKIN_IGNORE.
make_workspace() {
  local toplevel=/usr/share/catkin/cmake/toplevel.cmake
  if [ -e /opt/ros/noetic/share/catkin/cmake/toplevel.cmake ]; then toplevel=/opt/ros/noetic/share/catkin/cmake/toplevel.cmake; fi
  mkdir -p "$ws/src"
  [ -e "$build/CATKIN_IGNORE" ] || : >"$build/CATKIN_IGNORE"
  [ "$(readlink "$ws/src/urban_nav")" = ../../.. ] || ln -sfn ../../.. "$ws/src/urban_nav"
  [ "$(readlink "$ws/src/CMakeLists.txt")" = "$toplevel" ] || ln -sfn "$toplevel" "$ws/src/CMakeLists.txt"
}

# configure FOLDER OPTION...: the workspace in FOLDER/{build,devel,install}; does nothing when it was configured like
# this.
configure() {
  local folder=$1 wanted
  shift
  wanted="$root $*"
  if [ -f "$folder/build/build.ninja" ] && [ "$(cat "$folder/configured" 2>/dev/null)" = "$wanted" ]; then return; fi
  make_workspace
  if [ -f "$folder/configured" ] && [ "$(cut -d' ' -f1 "$folder/configured")" != "$root" ]; then
    rm -rf "$folder/build" "$folder/devel"  # the repository has moved, and CMake keeps absolute paths
  fi
  # catkin notes once, while it configures, which of these folders exist, and tests see no others in their environment.
  mkdir -p "$folder/build" "$folder/devel/bin" "$folder/devel/lib/pkgconfig" "$folder/devel/lib/python3/dist-packages"
  rm -f "$folder/configured"
  # ccache compares files as a whole: with it, headers are not precompiled. -DURBAN_NAV_UNITY=ON compiles all sources in
  # batches, which is quicker for a first build and slower for a changed file; -DURBAN_NAV_UNITY_TESTS=ON those of tests alone.
  if command -v ccache >/dev/null; then
    set -- "$@" -DCMAKE_CXX_COMPILER_LAUNCHER=ccache
  else
    set -- "$@" -DURBAN_NAV_PRECOMPILE=ON
  fi
  if ! cmake -S "$ws/src" -B "$folder/build" -G Ninja -DPYTHON_EXECUTABLE=/usr/bin/python3 \
      -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
      -DCATKIN_DEVEL_PREFIX="$folder/devel" -DCMAKE_INSTALL_PREFIX="$folder/install" "$@" >"$folder/configure.log" 2>&1; then
    grep -A12 -i 'error' "$folder/configure.log" >&2 || tail -20 "$folder/configure.log" >&2
    die "CMake did not configure (all of it: ${folder#"$root"/}/configure.log)"
  fi
  printf '%s\n' "$wanted" >"$folder/configured"
}

# As many compilers as processors, but 1.2 GB for each.
jobs() {
  local memory
  memory=$(awk '/^MemAvailable/ { print int($2 / 1200000) }' /proc/meminfo)
  echo $((memory < 1 ? 1 : memory < $(nproc) ? memory : $(nproc)))
}

# Says how far ninja is: one line that moves on a terminal, a line for every tenth elsewhere. All else goes through.
show_progress() {
  local what=$1 line tenth last=-1
  while IFS= read -r line; do
    if [[ $line =~ ^\[([0-9]+)/([0-9]+)\]\ (.*) ]]; then
      if [ "${BASH_REMATCH[2]}" -lt 3 ]; then continue; fi
      if [ -t 2 ]; then
        printf '\r\033[K%s %s' "$what ${BASH_REMATCH[1]}/${BASH_REMATCH[2]}" "${BASH_REMATCH[3]:0:50}" >&2
      else
        tenth=$((10 * BASH_REMATCH[1] / BASH_REMATCH[2]))
        if [ $tenth -gt $last ]; then say "$what ${BASH_REMATCH[1]}/${BASH_REMATCH[2]}"; last=$tenth; fi
      fi
    elif [[ $line != "ninja: "* && $line != "-- "* || $line == "ninja: error"* ]]; then
      say "$line"
    fi
  done
  if [ -t 2 ]; then printf '\r\033[K' >&2; fi
}

# compile FOLDER WHAT TARGET...: builds the targets, saying "WHAT n/N".
compile() {
  local folder=$1 what=$2
  shift 2
  NINJA_STATUS='[%f/%t] ' ninja -C "$folder/build" -j "${URBAN_NAV_JOBS:-$(jobs)}" "$@" 2>&1 | show_progress "$what"
  return "${PIPESTATUS[0]}"
}

# One build at a time in this repository; the lock is free again when the caller ends or calls unlock.
lock() {
  mkdir -p "$ws"
  exec 9>"$ws/lock"
  if ! flock -n 9; then
    say "Another build is at work in this repository; waiting for it"
    flock 9
  fi
}
unlock() { exec 9>&-; }

# configure_command: the workspace for the users' scripts, as it was configured before, or in batches and with warnings
# as warnings.
configure_command() {
  if [ -f "$ws/build/build.ninja" ] && [ "$(cut -d' ' -f1 "$ws/configured" 2>/dev/null)" = "$root" ]; then return; fi
  configure "$ws" -DCATKIN_ENABLE_TESTING=ON -DURBAN_NAV_BENCH=ON -DURBAN_NAV_WERROR=OFF -DURBAN_NAV_UNITY="${URBAN_NAV_UNITY:-ON}"
}

program=$ws/devel/lib/urban_nav/urban_nav

# Is the command there, and newer than all it is made of? Asked at every call, so it looks at dates alone.
command_is_current() {
  [ -x "$program" ] && [ -e "$ws/command.built" ] && [ -z "$(find "$root"/src "$root"/*/package.xml "$root"/*/CMakeLists.txt \
    "$root"/*/include "$root"/*/src "$root"/*/reference "$root"/packages.apt \
    \( -name test -o -name testing -o -name bench -o -name README.md \) -prune -o -newer "$ws/command.built" -print -quit)" ]
}

# Builds the command with the Python module, and what they need, nothing else.
build_command() (
  use_system_tools
  lock
  if command_is_current; then return; fi  # another call built it while this one waited
  install_packages
  configure_command
  if [ ! -x "$program" ]; then say "Building the urban_nav command; the first time takes some minutes"; fi
  : >"$ws/command.started"
  compile "$ws" "Building the urban_nav command" urban_nav urban_nav_python || die "the command does not compile"
  mv "$ws/command.started" "$ws/command.built"
)
