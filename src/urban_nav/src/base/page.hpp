// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace urban_nav {

/// Grade of a figure, shown by its colour.
enum class Grade { Good, Fair, Bad, Plain };

/// A number at the top of the page.
struct Tile {
  std::string value, unit, label;
  Grade grade = Grade::Plain;
};

/// A graded statement on the run.
struct Verdict {
  Grade grade = Grade::Plain;
  std::string headline;  ///< "Tracking held throughout"
  std::string sentence;  ///< the supporting figures
};

struct Figure {
  std::string title;
  std::string markup;   ///< HTML or SVG (renderSvg); if empty, the title is omitted
  std::string caption;  ///< explanation
  bool wide = false;    ///< over the whole width of the page
};

struct PagePicture {
  std::string caption;
  std::vector<unsigned char> jpeg;
  int width = 0, height = 0;
};

/// Attributes of a table row; empty ones are omitted.
struct RowAttributes {
  std::string id;    ///< of the row, as target of a link
  std::string edge;  ///< `data-edge`: ID of a closure in the store
  std::string link;  ///< address to which the first cell links
};

struct PageTable {
  std::string title;
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
  std::string caption;
  std::vector<RowAttributes> attributes = {};  ///< of the rows, or empty
};

struct Section {
  std::string id, title, introduction;
  std::vector<Figure> figures;
  std::vector<PagePicture> pictures;
  std::vector<PageTable> tables;
};

/// A report as plain data, filled by the stages and printed by renderPage().
struct Page {
  std::string title;
  std::string subtitle;
  bool running = false;   ///< the page is marked as unfinished and refreshes itself
  double progress = 0.0;  ///< 0...1, while running
  std::vector<Tile> tiles;
  std::vector<Verdict> verdicts;
  std::vector<Section> sections;
  std::string footer;
};

/// Returns a self-contained HTML file for light and dark, wide and narrow screens, and print.
std::string renderPage(const Page& page);

std::string base64(const std::vector<unsigned char>& bytes);

}  // namespace urban_nav
