// SPDX-License-Identifier: BSD-3-Clause
#include "materials/material_library.hpp"

#include <algorithm>
#include <cmath>

#include "materials/ground_tiles.hpp"
#include "materials/masonry.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

/// Returns the same hue with random changes of lightness and warmth.
Vector3f varied(const Vector3f& colour, double light, double warmth, Draw& draw) {
  const double l = 1.0 + light * draw.normal(), w = warmth * draw.normal();
  return (colour.array() *
          Vector3f(static_cast<float>(l * (1.0 + w)), static_cast<float>(l), static_cast<float>(l * (1.0 - w))).array())
      .cwiseMax(0.02F)
      .cwiseMin(0.85F);
}

void colour(Material& m, const Vector3f& a, const Vector3f& b, float contrast) {
  m.colours = {a, b};
  m.per_tone = a * contrast;
}

void infrared(Material& m, float a, float b, float contrast) {
  m.infrareds = {a, b};
  m.infrared_per_tone = a * contrast;
}

}  // namespace

Material MaterialLibrary::make(MaterialKind stuff, std::uint64_t variant) {
  Draw variation(hash(seed_, static_cast<std::uint64_t>(stuff), variant));
  Material m = stuff <= MaterialKind::RoofTile    ? wall(stuff, variation)
               : stuff <= MaterialKind::RoadPaint ? ground(stuff, variation)
               : stuff <= MaterialKind::Bark      ? plant(stuff, variation)
                                                  : made(stuff, variation);
  return m;
}

Layer MaterialLibrary::clouds(float stretch, float turn, const Vector3f& per_tone, const Vector3f& per_mix) {
  return {tile(Drawing::Clouds), stretch, {std::cos(turn), std::sin(turn)}, per_tone, per_mix};
}

Layer MaterialLibrary::streaks(float stretch, const Vector3f& per_tone) {
  return {tile(Drawing::Streaks), stretch, Vector2f::UnitX(), per_tone, Vector3f::Zero()};
}

Material MaterialLibrary::wall(MaterialKind stuff, Draw& v) {
  Material m;
  m.surface_class = SurfaceClass::TexturedWall;
  m.soaks = 0.25F;
  Vector3f base;
  switch (stuff) {
    case MaterialKind::Ashlar:
      m.name = "ashlar", m.detail = tile(Drawing::Ashlar);
      base = varied({0.46F, 0.37F, 0.24F}, 0.12, 0.05, v);
      colour(m, base, base * 0.45F, 0.8F), infrared(m, 0.4F, 0.3F, 0.35F);
      m.layers = {clouds(1.3F, 0.4F, base * 0.16F, base * 0.12F), streaks(1.0F, base * 0.3F)};
      break;
    case MaterialKind::Rubble:
      m.name = "rubble", m.detail = tile(Drawing::Rubble);
      base = varied({0.34F, 0.28F, 0.19F}, 0.1, 0.05, v);
      colour(m, base, Vector3f(0.33F, 0.29F, 0.23F), 0.9F), infrared(m, 0.38F, 0.38F, 0.35F);
      m.layers = {clouds(1.6F, 0.7F, base * 0.35F, Vector3f(-0.1F, -0.02F, -0.12F)), streaks(1.5F, base * 0.25F)};
      break;
    case MaterialKind::Brick:
    case MaterialKind::DarkBrick:
      m.name = stuff == MaterialKind::Brick ? "brick" : "dark brick", m.detail = tile(Drawing::Brick);
      base = stuff == MaterialKind::Brick ? varied({0.32F, 0.13F, 0.08F}, 0.15, 0.1, v)
                                          : varied({0.13F, 0.08F, 0.06F}, 0.15, 0.1, v);
      colour(m, base, Vector3f(0.38F, 0.34F, 0.28F), 1.0F), infrared(m, 0.42F, 0.5F, 0.4F);
      m.layers = {clouds(1.1F, 0.5F, base * 0.35F, base * 0.2F), streaks(1.2F, base * 0.3F)};
      break;
    case MaterialKind::Slate:
      m.name = "slate", m.detail = tile(Drawing::Slate);
      base = varied({0.12F, 0.13F, 0.15F}, 0.1, 0.05, v);
      colour(m, base, base * 0.3F, 1.0F), infrared(m, 0.2F, 0.1F, 0.5F);
      m.layers = {clouds(1.2F, 0.3F, base * 0.4F, Vector3f(0.03F, 0.03F, 0.01F)), Layer()};
      m.surface_class = SurfaceClass::Other, m.shines = 0.2F;
      break;
    case MaterialKind::RoofTile:
      m.name = "roof tile", m.detail = tile(Drawing::RoofTile);
      base = varied({0.28F, 0.12F, 0.07F}, 0.15, 0.08, v);
      colour(m, base, base * 0.35F, 1.0F), infrared(m, 0.4F, 0.2F, 0.5F);
      m.layers = {clouds(1.2F, 0.3F, base * 0.7F, Vector3f(-0.04F, 0.04F, 0.0F)), Layer()};
      m.surface_class = SurfaceClass::Other;
      break;
    default:
      m.name = "render", m.detail = tile(Drawing::Plaster), m.surface_class = SurfaceClass::SmoothWall;
      base = varied({0.6F, 0.56F, 0.47F}, 0.15, 0.07, v);
      colour(m, base, base * 0.5F, 0.55F), infrared(m, 0.65F, 0.4F, 0.3F);
      m.layers = {clouds(1.4F, 0.6F, base * 0.15F, base * 0.1F), streaks(1.0F, base * 0.28F)};
      break;
  }
  return m;
}

Material MaterialLibrary::ground(MaterialKind stuff, Draw& v) {
  Material m;
  m.surface_class = SurfaceClass::Paved;
  m.soaks = 0.45F, m.shines = 0.25F;
  Vector3f base;
  switch (stuff) {
    case MaterialKind::Slabs:
    case MaterialKind::Setts:
      m.name = stuff == MaterialKind::Slabs ? "slabs" : "setts",
      m.detail = tile(stuff == MaterialKind::Slabs ? Drawing::Slabs : Drawing::Setts);
      base = stuff == MaterialKind::Slabs ? varied({0.36F, 0.33F, 0.27F}, 0.1, 0.04, v)
                                          : varied({0.24F, 0.22F, 0.2F}, 0.1, 0.05, v);
      colour(m, base, base * 0.35F, 0.9F), infrared(m, 0.45F, 0.25F, 0.4F);
      m.layers = {clouds(1.0F, 0.4F, base * 0.2F, base * 0.18F), clouds(0.17F, 1.0F, base * 0.12F, Vector3f::Zero())};
      break;
    case MaterialKind::Gravel:
      m.name = "gravel", m.detail = tile(Drawing::Gravel), m.surface_class = SurfaceClass::DirtPath;
      base = varied({0.42F, 0.35F, 0.25F}, 0.1, 0.05, v);
      colour(m, base, base * 0.7F, 0.55F), infrared(m, 0.48F, 0.36F, 0.3F);
      m.layers = {clouds(1.7F, 0.4F, base * 0.2F, base * 0.15F), clouds(0.31F, 1.1F, base * 0.1F, base * 0.1F)};
      break;
    case MaterialKind::Lawn:
    case MaterialKind::Meadow:
      m.name = stuff == MaterialKind::Lawn ? "lawn" : "meadow", m.detail = tile(Drawing::Grass),
      m.surface_class = SurfaceClass::Grass;
      base = varied({0.09F, 0.15F, 0.035F}, 0.12, 0.08, v);
      m.colours = {base, Vector3f(0.21F, 0.19F, 0.075F)}, m.per_tone = Vector3f(0.14F, 0.18F, 0.06F);
      if (stuff == MaterialKind::Meadow) m.stretch = 1.35F, m.per_tone *= 1.3F;
      infrared(m, 0.5F, 0.45F, 0.5F), m.shines = 0.0F, m.soaks = 0.2F;
      m.layers = {clouds(1.5F, 0.4F, Vector3f(0.035F, 0.04F, 0.012F), Vector3f(0.08F, 0.05F, 0.0F)),
                  clouds(0.21F, 1.1F, Vector3f(0.045F, 0.055F, 0.018F), Vector3f(0.06F, 0.05F, 0.015F))};
      break;
    case MaterialKind::Soil:
      m.name = "soil", m.detail = tile(Drawing::Soil), m.surface_class = SurfaceClass::DirtPath;
      base = varied({0.2F, 0.15F, 0.095F}, 0.12, 0.06, v);
      colour(m, base, Vector3f(0.36F, 0.31F, 0.22F), 0.9F), infrared(m, 0.35F, 0.45F, 0.4F);
      m.layers = {clouds(1.4F, 0.4F, base * 0.25F, base * 0.2F), clouds(0.3F, 1.1F, base * 0.15F, base * 0.1F)};
      break;
    case MaterialKind::Kerb:
      m.name = "kerb", m.detail = tile(Drawing::Slabs);
      base = varied({0.4F, 0.38F, 0.35F}, 0.08, 0.03, v);
      colour(m, base, base * 0.4F, 0.8F), infrared(m, 0.5F, 0.3F, 0.4F);
      m.layers = {clouds(0.5F, 0.4F, base * 0.6F, base * 0.3F), Layer()};
      break;
    case MaterialKind::RoadPaint:
      m.name = "road paint", m.detail = tile(Drawing::Asphalt);
      base = Vector3f(0.62F, 0.62F, 0.58F);
      colour(m, base, base * 0.7F, 0.7F), infrared(m, 0.7F, 0.5F, 0.4F);
      m.layers = {clouds(0.3F, 0.4F, base * 0.8F, base * 0.6F), Layer()};
      break;
    default:
      m.name = "asphalt", m.detail = tile(Drawing::Asphalt);
      base = varied({0.125F, 0.122F, 0.117F}, 0.15, 0.03, v);  // worn, not fresh
      colour(m, base, Vector3f(0.38F, 0.365F, 0.34F), 1.0F), infrared(m, 0.16F, 0.3F, 0.6F);
      m.layers = {clouds(2.0F, 0.4F, base * 0.3F, base * 0.3F), clouds(0.25F, 1.1F, base * 0.18F, base * 0.18F)};
      break;
  }
  return m;
}

Material MaterialLibrary::plant(MaterialKind stuff, Draw& v) {
  Material m;
  m.surface_class = SurfaceClass::Foliage;
  m.soaks = 0.1F;
  infrared(m, 0.5F, 0.55F, 0.5F);
  const Vector3f green = varied({0.07F, 0.12F, 0.03F}, 0.2, 0.12, v),
                 light = varied({0.17F, 0.22F, 0.06F}, 0.15, 0.12, v);
  m.colours = {green, light}, m.per_tone = Vector3f(0.11F, 0.15F, 0.045F);
  if (stuff == MaterialKind::Leaves || stuff == MaterialKind::SmallLeaves) {
    const std::size_t kind = stuff == MaterialKind::Leaves ? 0 : 1;
    Leaves& leaves = leaves_[kind];
    if (!leaves.tile)
      leaves = kind == 0 ? drawLeaves(420, 0.09, 0.16, hash(seed_, 50)) : drawLeaves(900, 0.05, 0.1, hash(seed_, 51));
    m.name = kind == 0 ? "leaves" : "small leaves", m.detail = leaves.tile, m.cut = leaves.cut;
    return m;
  }
  m.layers = {clouds(0.5F, 0.3F, green * 1.2F, light * 0.4F), Layer()};
  m.name = "hedge";
  m.detail = tile(stuff == MaterialKind::Bark      ? Drawing::Bark
                  : stuff == MaterialKind::Flowers ? Drawing::Flowers
                                                   : Drawing::Hedge);
  if (stuff == MaterialKind::Shrub) m.name = "shrub", m.stretch = 1.6F;
  if (stuff == MaterialKind::Flowers) {
    m.name = "flowers";
    m.colours[1] = varied({0.5F, 0.16F, 0.25F}, 0.3, 0.5, v);
  }
  if (stuff == MaterialKind::Bark) {
    m.name = "bark", m.surface_class = SurfaceClass::Other;
    const Vector3f base = varied({0.2F, 0.16F, 0.12F}, 0.2, 0.06, v);
    colour(m, base, Vector3f(0.15F, 0.17F, 0.09F), 0.9F), infrared(m, 0.4F, 0.4F, 0.5F);
    m.layers = {clouds(0.3F, 0.0F, base * 0.5F, base * 0.3F), Layer()};
  }
  return m;
}

Material MaterialLibrary::made(MaterialKind stuff, Draw& v) {
  Material m;
  m.soaks = 0.1F;
  Vector3f base = Vector3f::Constant(0.3F);
  const auto plain = [&](const char* name, const Vector3f& c, float contrast, float ir) {
    m.name = name, m.detail = tile(Drawing::Plaster), base = c;
    colour(m, base, base * 0.6F, contrast), infrared(m, ir, ir, 0.2F);
  };
  switch (stuff) {
    case MaterialKind::Sash:
    case MaterialKind::Casement:
    case MaterialKind::ShopWindow:
      m.name = "window", m.anchored = true;
      m.detail = tile(stuff == MaterialKind::Sash       ? Drawing::Sash
                      : stuff == MaterialKind::Casement ? Drawing::Casement
                                                        : Drawing::Shop);
      m.colours = {Vector3f(0.09F, 0.09F, 0.09F), varied({0.62F, 0.6F, 0.55F}, 0.15, 0.04, v)},
      m.per_tone = Vector3f(0.26F, 0.24F, 0.21F);
      m.glass = {0.9F, 0.0F}, m.glosses = {0.3F, 0.03F}, m.infrareds = {0.08F, 0.55F};
      m.layers = {clouds(0.35F, 0.2F, Vector3f::Constant(0.04F), Vector3f::Constant(0.03F)), Layer()};
      break;
    case MaterialKind::Door:
    case MaterialKind::Boards:
      m.name = stuff == MaterialKind::Door ? "door" : "boards", m.detail = tile(Drawing::Boards);
      base = stuff == MaterialKind::Door ? varied({0.16F, 0.09F, 0.055F}, 0.3, 0.25, v)
                                         : varied({0.3F, 0.23F, 0.16F}, 0.2, 0.08, v);
      colour(m, base, base * 0.3F, 1.0F), infrared(m, 0.45F, 0.2F, 0.4F);
      m.layers = {streaks(0.4F, base * 0.8F), Layer()};
      break;
    case MaterialKind::CarPaint: {
      const Vector3f paints[] = {{0.5F, 0.5F, 0.5F},    {0.04F, 0.04F, 0.05F}, {0.3F, 0.03F, 0.03F},
                                 {0.04F, 0.08F, 0.25F}, {0.7F, 0.7F, 0.68F},   {0.15F, 0.17F, 0.18F},
                                 {0.05F, 0.15F, 0.1F}};
      plain("car paint", varied(paints[v.index(7)], 0.1, 0.03, v), 0.15F, static_cast<float>(v.uniform(0.1, 0.6)));
      m.surface_class = SurfaceClass::Vehicle, m.glosses = {0.12F, 0.1F};
      m.layers = {clouds(0.4F, 0.0F, base * 0.15F, base * 0.1F), Layer()};
      break;
    }
    case MaterialKind::CarGlass:
      plain("car glass", Vector3f(0.03F, 0.035F, 0.04F), 0.6F, 0.08F);
      m.surface_class = SurfaceClass::Vehicle, m.glosses = {0.35F, 0.3F};
      break;
    case MaterialKind::Rubber:
      plain("rubber", Vector3f(0.035F, 0.035F, 0.035F), 0.8F, 0.06F);
      m.surface_class = SurfaceClass::Vehicle;
      break;
    case MaterialKind::Iron: plain("iron", varied({0.06F, 0.065F, 0.065F}, 0.3, 0.05, v), 0.5F, 0.15F); break;
    case MaterialKind::Cloth:
      plain("cloth", varied(Vector3f::Constant(static_cast<float>(v.uniform(0.04, 0.35))), 0.1, 0.35, v), 0.6F, 0.5F);
      m.layers = {clouds(0.05F, 0.3F, base * 0.6F, base * 0.4F), Layer()};
      break;
    case MaterialKind::Skin: plain("skin", varied({0.42F, 0.27F, 0.19F}, 0.2, 0.05, v), 0.1F, 0.5F); break;
    default:
      plain("painted wood", varied({0.55F, 0.54F, 0.5F}, 0.2, 0.05, v), 0.4F, 0.6F);
      m.layers = {streaks(0.3F, base * 0.5F), Layer()};
      break;
  }
  return m;
}

std::shared_ptr<const Tile> MaterialLibrary::tile(Drawing drawing) {
  std::shared_ptr<const Tile>& t = tiles_[drawing];
  if (!t) t = draw(drawing);
  return t;
}

std::shared_ptr<const Tile> MaterialLibrary::draw(Drawing drawing) const {
  Bond bond;
  bond.seed = hash(seed_, static_cast<std::uint64_t>(drawing));
  const auto courses = [&](float period, float low, float high, float block_low, float block_high, float joint) {
    bond.period = period, bond.course_low = low, bond.course_high = high, bond.block_low = block_low,
    bond.block_high = block_high, bond.joint = joint;
  };
  switch (drawing) {
    case Drawing::Ashlar:
      courses(4.2F, 0.22F, 0.38F, 0.35F, 0.85F, 0.012F);
      bond.block_tone = 0.13F, bond.grain = 0.045F, bond.pits = 0.2F, bond.wobble = 0.003F;
      return drawBond(bond);
    case Drawing::Rubble: return drawRubble(15, 3.4F, bond.seed);
    case Drawing::Brick:
      bond.block_tone = 0.2F, bond.grain = 0.12F, bond.wobble = 0.0015F, bond.pits = 0.2F;
      return drawBond(bond);
    case Drawing::Slate:
      courses(3.2F, 0.2F, 0.2F, 0.32F, 0.32F, 0.008F);
      bond.block_tone = 0.2F, bond.shade = 0.35F, bond.wobble = 0.004F;
      return drawBond(bond);
    case Drawing::RoofTile:
      courses(2.4F, 0.12F, 0.12F, 0.2F, 0.2F, 0.008F);
      bond.block_tone = 0.22F, bond.shade = 0.4F, bond.wobble = 0.004F;
      return drawBond(bond);
    case Drawing::Slabs:
      courses(4.2F, 0.45F, 0.7F, 0.5F, 1.0F, 0.012F);
      bond.block_tone = 0.14F, bond.grain = 0.06F, bond.shade = 0.0F, bond.pits = 0.1F, bond.wobble = 0.002F;
      return drawBond(bond);
    case Drawing::Setts:
      courses(2.4F, 0.12F, 0.12F, 0.2F, 0.2F, 0.018F);
      bond.block_tone = 0.2F, bond.grain = 0.14F, bond.shade = 0.0F, bond.wobble = 0.006F;
      return drawBond(bond);
    case Drawing::Boards:
      courses(2.0F, 0.125F, 0.125F, 2.0F, 2.0F, 0.008F);
      bond.size = 512, bond.upright = true, bond.block_tone = 0.12F, bond.grain = 0.12F, bond.shade = 0.1F;
      return drawBond(bond);
    case Drawing::Gravel: return drawGravel(bond.seed);
    case Drawing::Asphalt: return drawAsphalt(bond.seed);
    case Drawing::Grass: return drawGrass(bond.seed);
    case Drawing::Soil: return drawSoil(bond.seed);
    case Drawing::Clouds: return drawClouds(bond.seed);
    case Drawing::Streaks: return drawStreaks(bond.seed);
    case Drawing::Hedge: return drawHedge(0.0, bond.seed);
    case Drawing::Flowers: return drawHedge(0.22, bond.seed);
    case Drawing::Bark: return drawBark(bond.seed);
    case Drawing::Sash: return drawWindow(3, 4, bond.seed);
    case Drawing::Casement: return drawWindow(2, 3, bond.seed);
    case Drawing::Shop: return drawWindow(3, 1, bond.seed);
    default: return drawPlaster(bond.seed);
  }
}

}  // namespace urban_nav_sim
