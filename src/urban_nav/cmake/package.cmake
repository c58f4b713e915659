# SPDX-License-Identifier: BSD-3-Clause
# Settings of cpack for a .deb of the whole workspace (scripts/make_deb.sh configures one for /usr).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME urban-nav)
set(CPACK_PACKAGE_VENDOR urban_nav)
set(CPACK_PACKAGE_VERSION ${${PROJECT_NAME}_VERSION})
set(CPACK_PACKAGE_CONTACT "The urban_nav maintainers <maintainers@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Trajectory, map and report from the recordings of a robot")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# Linked libraries of Debian, found by dpkg-shlibdeps; the Python module needs numpy.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Below /usr, libraries are in the folder of the architecture, in the devel space too.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CATKIN_DEVEL_PREFIX}/lib ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_LIB_DESTINATION})
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3, python3-numpy")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-roslaunch, libnodeletlib-tools, ros-robot-state-publisher, rviz")
include(CPack)
