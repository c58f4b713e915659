// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "segway_drivers/lms291/stream.hpp"
#include "segway_drivers/table/row_decoder.hpp"

namespace segway_drivers {

/// Appends a cell and a comma in front of all but the first. Values that are not finite are absent.
void appendCell(std::string& cells, const std::string& text);
void appendCell(std::string& cells, double value);
void appendCell(std::string& cells, float value);
void appendCell(std::string& cells, std::optional<double> value);

/// Cells of one message, in the order of rowColumns().
std::string lmsCells(const LmsScan& scan);

/// Decoders of rowColumns()' kinds.
std::unique_ptr<RowDecoder> makeLmsRows(const Parameters& parameters, RowDecoder::Sink sink);

}  // namespace segway_drivers
