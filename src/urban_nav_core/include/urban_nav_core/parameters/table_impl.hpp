// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <type_traits>
#include <utility>

/// Bodies of Table's templates; included only by table.hpp.
namespace urban_nav_core {
namespace detail {

template <typename Member>
constexpr ParameterType typeOfMember() {
  if constexpr (std::is_same_v<Member, bool>) return ParameterType::Bool;
  else if constexpr (std::is_same_v<Member, int>) return ParameterType::Integer;
  else if constexpr (std::is_same_v<Member, double>) return ParameterType::Number;
  else return ParameterType::Word;
}

template <typename Parameters, typename Member>
constexpr ParameterType typeOfMember(Member Parameters::*) {
  return typeOfMember<Member>();
}

inline void assign(bool& member, const ParameterValue& value) { member = std::get<bool>(value); }
inline void assign(int& member, const ParameterValue& value) {
  member = static_cast<int>(std::get<std::int64_t>(value));
}
inline void assign(double& member, const ParameterValue& value) {
  const auto* whole = std::get_if<std::int64_t>(&value.base());
  member = whole != nullptr ? static_cast<double>(*whole) : std::get<double>(value);
}
inline void assign(std::string& member, const ParameterValue& value) { member = std::get<std::string>(value); }

}  // namespace detail

template <typename Parameters>
Table<Parameters>::Table(std::string stage, std::vector<Row<Parameters>> rows)
    : stage_(std::move(stage)), rows_(std::move(rows)) {
  for (const Row<Parameters>& row : rows_) {
    const ParameterType type = std::visit([](auto member) { return detail::typeOfMember(member); }, row.member);
    infos_.push_back({row.name, row.unit, row.sentence, row.source, type, row.standard, row.low, row.high, row.words,
                      row.old_names, row.audience});
  }
  assertSound(stage_, infos_);
}

template <typename Parameters>
const Row<Parameters>& Table<Parameters>::row(const std::string& name) const {
  std::size_t at = 0;
  while (at < rows_.size() && rows_[at].name != name) ++at;
  assert(at < rows_.size());
  return rows_[at];
}

template <typename Parameters>
void Table<Parameters>::setDefaults(Parameters& parameters) const {
  for (const Row<Parameters>& each : rows_) set(parameters, each.name, each.standard);
}

template <typename Parameters>
ParameterValue Table<Parameters>::get(const Parameters& parameters, const std::string& name) const {
  return std::visit([&parameters](auto member) { return ParameterValue(parameters.*member); }, row(name).member);
}

template <typename Parameters>
void Table<Parameters>::set(Parameters& parameters, const std::string& name, const ParameterValue& value) const {
  std::visit([&](auto member) { detail::assign(parameters.*member, value); }, row(name).member);
}

}  // namespace urban_nav_core
