#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Does a clone in the src of somebody's own workspace build and run, by each of the usual ways? What is committed counts.
#   scripts/check_workspaces.sh [catkin_make|install|catkin_build]...     default: all three, some 15 minutes
set -eu
# shellcheck source=scripts/lib.sh
. "$(dirname "$(readlink -f "$0")")/lib.sh"
use_system_tools
install_packages catkin-tools
[ $# -gt 0 ] || set -- catkin_make install catkin_build
temporary=$(mktemp -d)
trap 'rm -rf "$temporary"' EXIT
if command -v ccache >/dev/null; then export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_BASEDIR=$temporary; fi
options=(-DPYTHON_EXECUTABLE=/usr/bin/python3 -DCATKIN_ENABLE_TESTING=OFF)

fresh_workspace() {
  mkdir -p "$temporary/$1/src"
  git clone -q "$root" "$temporary/$1/src/urban_nav"
}

# works SPACE: from a shell that sourced it, the command is on the path, the nodelet is known, and each launch file can be read.
works() (
  set +u
  # shellcheck disable=SC1090,SC1091
  . "$1/setup.bash"
  set -u
  export ROS_HOSTNAME=localhost ROS_HOME=$temporary/ros_home
  [ "$(command -v urban_nav)" = "$1/bin/urban_nav" ] || die "$1: urban_nav is not on the path"
  urban_nav --help >"$temporary/help"
  rosrun urban_nav urban_nav --help | cmp - "$temporary/help" || die "$1: rosrun starts another command"
  rospack plugins --attrib=plugin nodelet | grep -q '^swf_vo ' || die "$1: the nodelet is not known"
  local launch_files
  launch_files=$(find -L "$(rospack find urban_nav_launch)/launch" -name '*.launch')
  [ -n "$launch_files" ] || die "$1: no launch file"
  for file in $launch_files; do
    roslaunch --nodes urban_nav_launch "$(basename "$file")" bag:=/none.bag >"$temporary/nodes" || die "$1: $file cannot be read"
  done
  local port launched answers=no
  port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])')
  export ROS_MASTER_URI=http://localhost:$port
  roslaunch -p "$port" urban_nav_launch swf_vo.launch required:=true >"$temporary/launched" 2>&1 &
  launched=$!
  for _ in {1..60}; do
    if rosservice list 2>/dev/null | grep -qx /swf_vo/reset; then answers=yes; break; fi
    sleep 1
  done
  kill $launched || true
  wait $launched || true
  # Debian's image_proc ships a plugin description without content, of which pluginlib complains at every nodelet.
  if [ $answers = no ] || grep -v image_proc/nodelet_plugins.xml "$temporary/launched" | grep -qiE 'error|fail|has died|cannot'; then
    cat "$temporary/launched" >&2
    die "$1: swf_vo.launch does not run"
  fi
  say "ok: $1"
)

for way; do
  say "== $way"
  fresh_workspace "$way"
  cd "$temporary/$way"
  case $way in
    catkin_make)
      catkin_make -j"$(jobs)" "${options[@]}" >log 2>&1 || { tail -30 log >&2; die "catkin_make failed"; }
      works "$PWD/devel" ;;
    install)
      catkin_make install -j"$(jobs)" "${options[@]}" >log 2>&1 || { tail -30 log >&2; die "catkin_make install failed"; }
      rm -rf src build devel  # nothing installed may lean on what it was made from
      works "$PWD/install" ;;
    catkin_build)
      catkin config --install --cmake-args "${options[@]}" >/dev/null
      catkin build -j"$(jobs)" -p1 --no-status --summarize >log 2>&1 || { tail -30 log >&2; die "catkin build failed"; }
      rm -rf src build devel
      works "$PWD/install" ;;
    *) die "$way: catkin_make, install or catkin_build" ;;
  esac
done
