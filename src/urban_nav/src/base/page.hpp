// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace urban_nav {

/// How good a figure is, in the page's colours and words.
enum class Grade { Good, Fair, Bad, Plain };

/// A number at the top of the page.
struct Tile {
  std::string value, unit, label;
  Grade grade = Grade::Plain;
};

/// A sentence that answers a question the reader has.
struct Verdict {
  Grade grade = Grade::Plain;
  std::string headline;  ///< "Tracking held throughout"
  std::string sentence;  ///< what it rests on, with figures
};

struct Figure {
  std::string title;
  std::string markup;   ///< HTML or SVG, as renderSvg makes it; without it the title is left out too
  std::string caption;  ///< how to read it
  bool wide = false;    ///< over the whole width of the page
};

struct PagePicture {
  std::string caption;
  std::vector<unsigned char> jpeg;
  int width = 0, height = 0;
};

struct PageTable {
  std::string title;
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
  std::string caption;
};

struct Section {
  std::string id, title, introduction;
  std::vector<Figure> figures;
  std::vector<PagePicture> pictures;
  std::vector<PageTable> tables;
};

/// A report as plain data: stages fill it, renderPage makes the page.
struct Page {
  std::string title;
  std::string subtitle;
  bool running = false;   ///< the page says so and refreshes itself
  double progress = 0.0;  ///< 0...1, while running
  std::vector<Tile> tiles;
  std::vector<Verdict> verdicts;
  std::vector<Section> sections;
  std::string footer;
};

/// One HTML file that needs no other: light and dark, wide and narrow, on paper too.
std::string renderPage(const Page& page);

std::string base64(const std::vector<unsigned char>& bytes);

}  // namespace urban_nav
