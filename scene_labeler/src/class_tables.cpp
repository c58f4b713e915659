// SPDX-License-Identifier: BSD-3-Clause
#include "class_tables.hpp"

#include <algorithm>

namespace scene_labeler {
namespace {

// Two-wheelers count as `other`, like people. Terrain of all sets is grass, other low vegetation and soil without
// distinction; the commonest of these is `grass`. Walls are of unknown kind.
constexpr SceneClass kIgnore = SceneClass::None, kOther = SceneClass::Other, kGrass = SceneClass::Grass,
                     kPaved = SceneClass::Paved, kWall = SceneClass::Wall, kFoliage = SceneClass::Foliage,
                     kVehicle = SceneClass::Vehicle;

/// KITTI semantic segmentation (Alhaija et al. 2018), with the ids of Cityscapes, and KITTI-360 (Liao et al. 2022),
/// which adds 34 to 44: kitti360scripts/helpers/labels.py, column id.
ClassTable kitti() {
  return {"kitti",
          "KITTI semantics and KITTI-360",
          ~0,
          {{-1, "license plate", kVehicle},
           {0, "unlabeled", kIgnore},
           {1, "ego vehicle", kIgnore},
           {2, "rectification border", kIgnore},
           {3, "out of roi", kIgnore},
           {4, "static", kIgnore},
           {5, "dynamic", kIgnore},
           {6, "ground", kIgnore},  // of unknown kind
           {7, "road", kPaved},
           {8, "sidewalk", kPaved},
           {9, "parking", kPaved},
           {10, "rail track", kIgnore},  // in asphalt, gravel or grass
           {11, "building", kWall},
           {12, "wall", kWall},
           {13, "fence", kOther},
           {14, "guard rail", kOther},
           {15, "bridge", kOther},
           {16, "tunnel", kWall},
           {17, "pole", kOther},
           {18, "polegroup", kOther},
           {19, "traffic light", kOther},
           {20, "traffic sign", kOther},
           {21, "vegetation", kFoliage},
           {22, "terrain", kGrass},
           {23, "sky", kIgnore},
           {24, "person", kOther},
           {25, "rider", kOther},
           {26, "car", kVehicle},
           {27, "truck", kVehicle},
           {28, "bus", kVehicle},
           {29, "caravan", kVehicle},
           {30, "trailer", kVehicle},
           {31, "train", kVehicle},
           {32, "motorcycle", kOther},
           {33, "bicycle", kOther},
           {34, "garage", kWall},
           {35, "gate", kOther},
           {36, "stop", kOther},
           {37, "small pole", kOther},
           {38, "lamp", kOther},
           {39, "trash bin", kOther},
           {40, "vending machine", kOther},
           {41, "box", kOther},
           {42, "unknown construction", kIgnore},
           {43, "unknown vehicle", kVehicle},
           {44, "unknown object", kOther}}};
}

/// SemanticKITTI (Behley et al. 2019): semantic-kitti-api, config/semantic-kitti.yaml. The upper 16 bits of a label
/// are the instance.
ClassTable semanticKitti() {
  return {"semantickitti",
          "SemanticKITTI",
          0xffff,
          {{0, "unlabeled", kIgnore},
           {1, "outlier", kIgnore},
           {10, "car", kVehicle},
           {11, "bicycle", kOther},
           {13, "bus", kVehicle},
           {15, "motorcycle", kOther},
           {16, "on-rails", kVehicle},
           {18, "truck", kVehicle},
           {20, "other-vehicle", kVehicle},
           {30, "person", kOther},
           {31, "bicyclist", kOther},
           {32, "motorcyclist", kOther},
           {40, "road", kPaved},
           {44, "parking", kPaved},
           {48, "sidewalk", kPaved},
           {49, "other-ground", kIgnore},  // of unknown kind
           {50, "building", kWall},
           {51, "fence", kOther},
           {52, "other-structure", kOther},
           {53, "error-object", kIgnore},
           {60, "lane-marking", kPaved},
           {70, "vegetation", kFoliage},
           {71, "trunk", kFoliage},
           {72, "terrain", kGrass},
           {80, "pole", kOther},
           {81, "traffic-sign", kOther},
           {99, "other-object", kOther},
           {252, "moving-car", kVehicle},
           {253, "moving-bicyclist", kOther},
           {254, "moving-person", kOther},
           {255, "moving-motorcyclist", kOther},
           {256, "moving-on-rails", kVehicle},
           {257, "moving-bus", kVehicle},
           {258, "moving-truck", kVehicle},
           {259, "moving-other-vehicle", kVehicle}}};
}

/// nuScenes-lidarseg (Fong et al. 2021): `index` of the released v1.0/category.json, which numbers the names in
/// alphabetical order. (The annotator instructions of the devkit number 25 to 27, 29 and 30 otherwise; the files do
/// not.)
ClassTable nuScenes() {
  return {"nuscenes",
          "nuScenes-lidarseg",
          ~0,
          {{0, "noise", kIgnore},
           {1, "animal", kOther},
           {2, "human.pedestrian.adult", kOther},
           {3, "human.pedestrian.child", kOther},
           {4, "human.pedestrian.construction_worker", kOther},
           {5, "human.pedestrian.personal_mobility", kOther},
           {6, "human.pedestrian.police_officer", kOther},
           {7, "human.pedestrian.stroller", kOther},
           {8, "human.pedestrian.wheelchair", kOther},
           {9, "movable_object.barrier", kOther},
           {10, "movable_object.debris", kOther},
           {11, "movable_object.pushable_pullable", kOther},
           {12, "movable_object.trafficcone", kOther},
           {13, "static_object.bicycle_rack", kOther},
           {14, "vehicle.bicycle", kOther},
           {15, "vehicle.bus.bendy", kVehicle},
           {16, "vehicle.bus.rigid", kVehicle},
           {17, "vehicle.car", kVehicle},
           {18, "vehicle.construction", kVehicle},
           {19, "vehicle.emergency.ambulance", kVehicle},
           {20, "vehicle.emergency.police", kVehicle},
           {21, "vehicle.motorcycle", kOther},
           {22, "vehicle.trailer", kVehicle},
           {23, "vehicle.truck", kVehicle},
           {24, "flat.driveable_surface", kPaved},
           {25, "flat.other", kIgnore},  // of unknown kind
           {26, "flat.sidewalk", kPaved},
           {27, "flat.terrain", kGrass},
           {28, "static.manmade", kWall},  // mostly buildings; also fences, poles and signs
           {29, "static.other", kOther},
           {30, "static.vegetation", kFoliage},
           {31, "vehicle.ego", kIgnore}}};
}

const std::array<ClassTable, 3>& allClassTables() {
  static const std::array<ClassTable, 3> tables = {kitti(), semanticKitti(), nuScenes()};
  return tables;
}

}  // namespace

const ClassTable* findClassTable(std::string_view name) {
  const auto& tables = allClassTables();
  const auto found =
      std::find_if(tables.begin(), tables.end(), [&](const ClassTable& table) { return name == table.name; });
  return found == tables.end() ? nullptr : &*found;
}

std::string classTableNames() {
  std::string names;
  for (const ClassTable& table : allClassTables()) names += (names.empty() ? "" : ", ") + std::string(table.name);
  return names;
}

}  // namespace scene_labeler
