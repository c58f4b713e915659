// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/run_covariances.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Quaterniond;
using urban_nav_core::Vector3d;

constexpr int kPoses = 10;

/// Files of a run that turns, with a camera mounted on base_link.
class RunCovariancesTest : public ::testing::Test {
 protected:
  void writeRun(const Pose& T_base_camera) const {
    urban_nav_core::Trajectory base;
    std::vector<Pose> camera;
    std::string rows = urban_nav_core::covarianceHeader();
    const Pose T_base_map(Quaterniond(0.8, 0.0, 0.0, 0.6), Vector3d(3.0, 4.0, 0.0));
    for (int i = 0; i < kPoses; ++i) {
      const Pose T_first_base(Quaterniond(Eigen::AngleAxisd(0.1 * i, Vector3d(0.1, 0.2, 1.0).normalized())),
                              Vector3d(0.5 * i, 0.1 * i, 0.0));
      base.append(1'000'000'000 + i * std::int64_t{100'000'000}, T_base_map * T_first_base);
      camera.push_back(T_base_camera.inverse() * T_first_base * T_base_camera);
      rows += urban_nav_core::printCovarianceRow(urban_nav_core::CovarianceRow{
          base.back().stamp, urban_nav_core::Health::Ok, 1e-4 * (i + 1) * urban_nav_core::Matrix6d::Identity()});
    }
    urban_nav_core::writeTum(folder.file("trajectory.tum"), base);
    urban_nav_core::writeKitti(folder.file("trajectory.kitti"), camera);
    urban_nav_core::writeAtomically(folder.file("covariance.csv"), rows);
  }
  RunCovariances read(const std::string& name) const {
    return readRunCovariances(urban_nav_input::readTrajectory(folder.file(name)));
  }

  const urban_nav_input::testing::TemporaryFolder folder;
  const Quaterniond optical{0.5, -0.5, 0.5, -0.5};
};

TEST_F(RunCovariancesTest, AreThoseOfACameraThatOnlyHasOtherAxes) {
  writeRun(Pose(optical, Vector3d::Zero()));
  EXPECT_EQ(read("trajectory.kitti").rows.size(), std::size_t{kPoses});
  EXPECT_EQ(read("trajectory.kitti").warning, "");
  EXPECT_EQ(read("trajectory.tum").rows.size(), std::size_t{kPoses});
}

TEST_F(RunCovariancesTest, AreNotThoseOfACameraMountedElsewhere) {
  const Pose ahead(optical, Vector3d(0.3, 0.0, 0.0)),
      tilted(Quaterniond(Eigen::AngleAxisd(0.05, Vector3d::UnitY())) * optical, Vector3d::Zero());
  for (const Pose& T_base_camera : {ahead, tilted}) {
    writeRun(T_base_camera);
    const RunCovariances found = read("trajectory.kitti");
    EXPECT_TRUE(found.rows.empty());
    EXPECT_NE(found.warning.find("mounted off base_link"), std::string::npos) << found.warning;
    EXPECT_NE(found.warning.find("evaluate trajectory.tum"), std::string::npos) << found.warning;
    EXPECT_EQ(read("trajectory.tum").rows.size(), std::size_t{kPoses});
    EXPECT_EQ(read("trajectory.tum").warning, "");
  }
}

TEST_F(RunCovariancesTest, OfACameraNeedThePosesOfBaseLink) {
  writeRun(Pose(optical, Vector3d::Zero()));
  std::filesystem::remove(folder.file("trajectory.tum"));
  const RunCovariances found = read("trajectory.kitti");
  EXPECT_TRUE(found.rows.empty());
  EXPECT_NE(found.warning.find("no trajectory.tum"), std::string::npos) << found.warning;
}

TEST_F(RunCovariancesTest, AreMissingWithAReasonWhereAFileCannotBeRead) {
  writeRun(Pose(optical, Vector3d::Zero()));
  urban_nav_core::writeAtomically(folder.file("covariance.csv"), "no covariances");
  EXPECT_EQ(read("trajectory.tum").warning.rfind("no NEES: ", 0), 0U);
  std::filesystem::remove(folder.file("covariance.csv"));
  EXPECT_EQ(read("trajectory.tum").warning, "");
  EXPECT_TRUE(read("trajectory.tum").rows.empty());
}

}  // namespace
}  // namespace urban_nav
