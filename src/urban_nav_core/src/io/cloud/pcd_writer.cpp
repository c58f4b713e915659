// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/cloud/pcd_writer.hpp"

#include <utility>

namespace urban_nav_core {
namespace {

constexpr std::size_t kPcdCountDigits = 20;  // of the largest number of points

std::size_t pcdPointBytes(const std::vector<PcdField>& fields) {
  std::size_t bytes = 0;
  for (const PcdField& field : fields) bytes += static_cast<std::size_t>(field.bytes);
  return bytes;
}

}  // namespace

std::string pcdHeader(const std::vector<PcdField>& fields, std::size_t points) {
  std::string names = "FIELDS", sizes = "SIZE", types = "TYPE", counts = "COUNT";
  for (const PcdField& field : fields) {
    names += " " + field.name;
    sizes += " " + std::to_string(field.bytes);
    types += std::string(" ") + field.type;
    counts += " 1";
  }
  const std::string number = std::to_string(points);
  const std::string filling(2 * (kPcdCountDigits - number.size()), ' ');
  return "# .PCD v0.7 - Point Cloud Data file format" + filling + "\nVERSION 0.7\n" + names + "\n" + sizes + "\n" +
         types + "\n" + counts + "\nWIDTH " + number + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + number +
         "\nDATA binary\n";
}

PcdWriter::PcdWriter(const std::string& path, std::vector<PcdField> fields)
    : fields_(std::move(fields)), file_(path, pcdHeader(fields_, 0).size(), pcdPointBytes(fields_)) {}

}  // namespace urban_nav_core
