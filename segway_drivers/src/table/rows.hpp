// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "segway_drivers/gps/fix.hpp"
#include "segway_drivers/lms291/scan.hpp"
#include "segway_drivers/segway_rmp/can_frame.hpp"
#include "segway_drivers/table/row_decoder.hpp"
#include "segway_drivers/xsens_mti/sample.hpp"

namespace segway_drivers {

/// Appends a cell, preceded by a comma except for the first. Non-finite values give empty cells.
void appendCell(std::string& cells, const std::string& text);
void appendCell(std::string& cells, double value);
void appendCell(std::string& cells, float value);

/// Returns the cells of one message in the order of rowColumns().
std::string lmsCells(const LmsScan& scan);
std::string mtiCells(const MtiSample& sample);
std::string rmpCells(const CanFrame& frame);
std::string gpsCells(const GpsFix& fix);

/// Make the decoders of the kinds of rowColumns().
std::unique_ptr<RowDecoder> makeLmsRows(const Parameters& parameters, RowDecoder::Sink sink);
std::unique_ptr<RowDecoder> makeMtiRows(const Parameters& parameters, RowDecoder::Sink sink);
std::unique_ptr<RowDecoder> makeRmpRows(const Parameters& parameters, RowDecoder::Sink sink);
std::unique_ptr<RowDecoder> makeCandumpRows(const Parameters& parameters, RowDecoder::Sink sink);
std::unique_ptr<RowDecoder> makeGpsRows(const Parameters& parameters, RowDecoder::Sink sink);
std::unique_ptr<RowDecoder> makeBb2Rows(const Parameters& parameters, const ImageFolder& images, RowDecoder::Sink sink);
std::unique_ptr<RowDecoder> makeLadybugRows(const Parameters& parameters, const ImageFolder& images,
                                            RowDecoder::Sink sink);

}  // namespace segway_drivers
