// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/instances/instance_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace scene_labeler {
namespace {

constexpr double kTolerance = 0.2;  // m

/// Car in plan view.
struct Car {
  double x = 0.0, y = 0.0, heading = 0.0, length = 4.2, width = 1.8;

  Eigen::Vector2d at(double along, double across) const {
    return Eigen::Vector2d(x, y) + along * Eigen::Vector2d(std::cos(heading), std::sin(heading)) +
           across * Eigen::Vector2d(-std::sin(heading), std::cos(heading));
  }
  bool covers(const Eigen::Vector2d& place) const {
    const Eigen::Vector2d p = place - Eigen::Vector2d(x, y);
    return std::abs(std::cos(heading) * p.x() + std::sin(heading) * p.y()) < 0.5 * length &&
           std::abs(-std::sin(heading) * p.x() + std::cos(heading) * p.y()) < 0.5 * width;
  }
};

/// Ground at z = 0.5 with things on it, with noise of 1 cm.
class Street {
 public:
  enum Sides { kLeft = 1, kRight = 2, kEnds = 4, kAll = 7 };

  void addCar(const Car& car, int sides = kAll, urban_nav_core::StampNs stamp = 100) {
    cars_.push_back(car);
    const double a = 0.5 * car.length, b = 0.5 * car.width;
    for (double z = 0.7; z <= 2.0; z += 0.1) {
      for (double along = -a; along <= a; along += 0.08) {
        if ((sides & kLeft) != 0) add(car.at(along, b), z, SceneClass::Vehicle, stamp);
        if ((sides & kRight) != 0) add(car.at(along, -b), z, SceneClass::Vehicle, stamp);
      }
      for (double across = -b; across <= b && (sides & kEnds) != 0; across += 0.08) {
        add(car.at(a, across), z, SceneClass::Vehicle, stamp);
        add(car.at(-a, across), z, SceneClass::Vehicle, stamp);
      }
    }
  }
  /// A round thing of the class `other`.
  void addColumn(double x, double y, double diameter, double height, double base = 0.0) {
    for (double z = 0.5 + base; z <= 0.5 + height; z += 0.08)
      for (int i = 0; i < 12; ++i)
        add({x + 0.5 * diameter * std::cos(0.5 * i), y + 0.5 * diameter * std::sin(0.5 * i)}, z, SceneClass::Other);
  }
  /// Ground outside the cars.
  void pave() {
    for (double x = -20.0; x < 20.0; x += 0.12)
      for (double y = -20.0; y < 20.0; y += 0.12)
        if (std::none_of(cars_.begin(), cars_.end(), [&](const Car& car) { return car.covers({x, y}); }))
          add({x, y}, 0.5, SceneClass::Paved);
  }
  void add(const Eigen::Vector2d& place, double z, SceneClass label, urban_nav_core::StampNs stamp = 100) {
    finder_.add(Eigen::Vector3d(place.x() + noise(), place.y() + noise(), z + noise()).cast<float>(),
                {label, 230, false}, stamp);
  }
  std::vector<Instance> find(InstanceKind kind) const {
    std::vector<Instance> of_kind;
    for (const Instance& instance : finder_.find())
      if (instance.kind == kind) of_kind.push_back(instance);
    return of_kind;
  }
  InstanceFinder& finder() { return finder_; }

 private:
  double noise() { return normal_(random_); }

  std::mt19937 random_{7};
  std::normal_distribution<double> normal_{0.0, 0.01};
  std::vector<Car> cars_;
  InstanceFinder finder_;
};

void expectCar(const Instance& found, const Car& car) {
  EXPECT_LT((found.box.centre - Eigen::Vector2d(car.x, car.y)).norm(), kTolerance);
  EXPECT_NEAR(found.box.length, car.length, kTolerance);
  EXPECT_NEAR(found.box.width, car.width, kTolerance);
  EXPECT_LT(std::abs(std::remainder(found.box.heading - car.heading, M_PI)), 0.05);
  EXPECT_NEAR(found.bottom, 0.5, kTolerance);
  EXPECT_NEAR(found.height, 1.5, kTolerance);
  EXPECT_NEAR(found.probability, 230.0 / 255.0, 1e-6);
}

TEST(InstanceFinder, FindsTheCarsPeopleAndPolesOfAStreet) {
  Street street;
  const std::vector<Car> cars = {{-10.0, 3.0, 0.1}, {0.0, -4.0, 0.8}, {9.0, 5.0, 1.5, 4.6, 1.9}};
  for (const Car& car : cars) street.addCar(car);
  const std::vector<Eigen::Vector2d> people = {{-3.0, 2.0}, {5.0, -8.0}};
  street.addColumn(people[0].x(), people[0].y(), 0.45, 1.75);
  street.addColumn(people[1].x(), people[1].y(), 0.6, 1.3);
  const std::vector<Eigen::Vector2d> poles = {{-15.0, -6.0}, {-7.0, -7.0}, {2.0, 8.0}, {8.0, -2.0}, {15.0, 1.0}};
  for (std::size_t i = 0; i < poles.size(); ++i)
    street.addColumn(poles[i].x(), poles[i].y(), i == 2 ? 0.45 : 0.15, i == 3 ? 1.5 : 5.0);
  street.addColumn(12.0, -12.0, 0.2, 0.6);       // a bollard
  street.addColumn(-12.0, 12.0, 0.3, 3.0, 1.5);  // a sign that hangs
  for (double x = 0.0; x < 6.0; x += 0.08)       // a fence
    for (double z = 0.5; z < 1.9; z += 0.1) street.add({x, 14.0}, z, SceneClass::Other);
  street.pave();
  const std::vector<Instance> vehicles = street.find(InstanceKind::Vehicle);
  ASSERT_EQ(vehicles.size(), cars.size());
  for (std::size_t i = 0; i < cars.size(); ++i) expectCar(vehicles[i], cars[i]);
  const std::vector<Instance> persons = street.find(InstanceKind::Person);
  ASSERT_EQ(persons.size(), people.size());
  for (std::size_t i = 0; i < people.size(); ++i) EXPECT_LT((persons[i].box.centre - people[i]).norm(), kTolerance);
  EXPECT_NEAR(persons[0].height, 1.75, kTolerance);
  EXPECT_NEAR(persons[1].box.length, 0.6, kTolerance);
  const std::vector<Instance> columns = street.find(InstanceKind::Pole);
  ASSERT_EQ(columns.size(), poles.size());
  for (std::size_t i = 0; i < poles.size(); ++i) {
    EXPECT_LT((columns[i].box.centre - poles[i]).norm(), kTolerance);
    EXPECT_NEAR(columns[i].height, i == 3 ? 1.5 : 5.0, kTolerance);
  }
}

TEST(InstanceFinder, JoinsTheSidesOfACarThatWereSeenInDifferentPasses) {
  Street street;
  const Car car{2.0, 1.0, 0.4};
  street.addCar(car, Street::kLeft, 300);
  street.addCar(car, Street::kRight, 50);
  street.pave();
  const std::vector<Instance> vehicles = street.find(InstanceKind::Vehicle);
  ASSERT_EQ(vehicles.size(), 1U);
  expectCar(vehicles[0], car);
  EXPECT_EQ(vehicles[0].first, 50);
  EXPECT_EQ(vehicles[0].last, 300);
}

TEST(InstanceFinder, KeepsCarsApartWhereFreeGroundSeparatesThem) {
  Street street;
  const std::vector<Car> cars = {{-5.0, 0.0, 0.0, 2.4, 1.6},  // two short ones, as long as a van together
                                 {-2.0, 0.0, 0.0, 2.4, 1.6},
                                 {6.0, 0.0, 0.0},  // bumper to bumper
                                 {10.65, 0.0, 0.0}};
  for (const Car& car : cars) street.addCar(car);
  street.pave();
  const std::vector<Instance> vehicles = street.find(InstanceKind::Vehicle);
  ASSERT_EQ(vehicles.size(), cars.size());
  for (std::size_t i = 0; i < cars.size(); ++i) expectCar(vehicles[i], cars[i]);
}

TEST(InstanceFinder, DoesNotDependOnTheOrderOfPointsOrOnThoseWithoutAPlace) {
  const auto find = [](bool is_reversed) {
    Street street;
    const std::vector<Car> cars = {{-10.0, 3.0, 0.1}, {4.0, -4.0, 0.8}};
    street.addCar(cars[is_reversed ? 1 : 0]);
    street.addCar(cars[is_reversed ? 0 : 1]);
    street.addColumn(0.0, 5.0, 0.15, 4.0);
    street.pave();
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    street.finder().add({kNan, 0.0F, 0.0F}, {SceneClass::Vehicle, 200, false}, 1);
    street.finder().add({0.0F, 0.0F, 9.0F}, {SceneClass::None, 0, true}, 1);
    return street.finder().find();
  };
  const std::vector<Instance> a = find(false), b = find(true);
  ASSERT_EQ(a.size(), 3U);
  ASSERT_EQ(b.size(), 3U);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].kind, b[i].kind);
    EXPECT_LT((a[i].box.centre - b[i].box.centre).norm(), 0.05);
    EXPECT_EQ(a[i].first, 100);
  }
  EXPECT_TRUE(InstanceFinder().find().empty());
}

}  // namespace
}  // namespace scene_labeler
