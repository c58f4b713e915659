// SPDX-License-Identifier: BSD-3-Clause
#include "base/page.hpp"

#include <algorithm>
#include <cstddef>

#include "base/page_style.hpp"
#include "base/plot.hpp"

namespace urban_nav {

namespace {

constexpr std::size_t kMostTilesAcross = 6;
constexpr std::size_t kLongTable = 60;  // rows; longer tables scroll

const char* classify(Grade grade) {
  switch (grade) {
    case Grade::Good: return "good";
    case Grade::Fair: return "fair";
    case Grade::Bad: return "bad";
    case Grade::Plain: break;
  }
  return "plain";
}

const char* toMark(Grade grade) {
  switch (grade) {
    case Grade::Good: return "&#10003;";
    case Grade::Fair: return "!";
    case Grade::Bad: return "&#10007;";
    case Grade::Plain: break;
  }
  return "i";
}

/// Returns the machine-readable attribute of a verdict, " data-verdict=..."; empty for a plain one.
std::string verdictAttribute(Grade grade) {
  return grade == Grade::Plain ? "" : " data-verdict=\"" + std::string(classify(grade)) + "\"";
}

std::string makeTiles(const std::vector<Tile>& tiles) {
  const std::size_t across = tiles.size() <= kMostTilesAcross ? tiles.size() : (tiles.size() + 1) / 2;
  std::string html =
      "<div class=\"tiles\" style=\"--across: " + std::to_string(std::max<std::size_t>(1, across)) + "\">";
  for (const Tile& tile : tiles) {
    html += "<div class=\"tile " + std::string(classify(tile.grade)) + "\"><div class=\"value\">" +
            escapeHtml(tile.value) + "<small> " + escapeHtml(tile.unit) + "</small></div><div class=\"what\">" +
            escapeHtml(tile.label) + "</div></div>";
  }
  return html + "</div>\n";
}

std::string formatVerdicts(const std::vector<Verdict>& verdicts) {
  std::string html = "<ul class=\"verdicts\">";
  for (const Verdict& verdict : verdicts) {
    html += "<li class=\"" + std::string(classify(verdict.grade)) + "\"" + verdictAttribute(verdict.grade) +
            "><span class=\"mark\">" + toMark(verdict.grade) + "</span><div><b>" + escapeHtml(verdict.headline) +
            "</b> " + escapeHtml(verdict.sentence) + "</div></li>";
  }
  return html + "</ul>\n";
}

std::string formatFigures(const std::vector<Figure>& figures) {
  std::string html = "<div class=\"figures\">";
  for (const Figure& figure : figures) {
    if (figure.markup.empty()) continue;
    html += std::string("<figure") + (figure.wide ? " class=\"wide\"" : "") + "><h3>" + escapeHtml(figure.title) +
            "</h3>" + figure.markup + "<figcaption>" + escapeHtml(figure.caption) + "</figcaption></figure>\n";
  }
  return html + "</div>\n";
}

std::string makePictures(const std::vector<PagePicture>& pictures) {
  std::string html = "<div class=\"pictures\">";
  for (const PagePicture& picture : pictures) {
    html += "<figure><img alt=\"" + escapeHtml(picture.caption) + "\" width=\"" + std::to_string(picture.width) +
            "\" height=\"" + std::to_string(picture.height) + "\" src=\"data:image/jpeg;base64," +
            base64(picture.jpeg) + "\"><figcaption>" + escapeHtml(picture.caption) + "</figcaption></figure>\n";
  }
  return html + "</div>\n";
}

/// Returns a row; a cell with several lines keeps them.
std::string makeRow(const std::vector<std::string>& cells, const RowAttributes& attributes) {
  std::string html = "<tr";
  if (!attributes.id.empty()) html += " id=\"" + escapeHtml(attributes.id) + "\"";
  if (!attributes.edge.empty()) html += " data-edge=\"" + escapeHtml(attributes.edge) + "\"";
  html += ">";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool has_lines = cells[i].find('\n') != std::string::npos;
    const std::string text = i == 0 && !attributes.link.empty()
                                 ? "<a href=\"" + escapeHtml(attributes.link) + "\">" + escapeHtml(cells[i]) + "</a>"
                                 : escapeHtml(cells[i]);
    html += (has_lines ? "<td class=\"lines\">" : "<td>") + text + "</td>";
  }
  return html + "</tr>\n";
}

std::string makeTable(const PageTable& table) {
  std::string html = table.title.empty() ? "" : "<h3>" + escapeHtml(table.title) + "</h3>";
  html +=
      std::string("<div class=\"scroll") + (table.rows.size() > kLongTable ? " long" : "") + "\"><table><thead><tr>";
  for (const std::string& cell : table.head) html += "<th>" + escapeHtml(cell) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    html += makeRow(table.rows[i], i < table.attributes.size() ? table.attributes[i] : RowAttributes());
  html += "</tbody></table></div>";
  return table.caption.empty() ? html : html + "<p class=\"caption\">" + escapeHtml(table.caption) + "</p>";
}

std::string makeSection(const Section& section) {
  std::string html = "<section id=\"" + section.id + "\"><h2>" + escapeHtml(section.title) + "</h2>\n";
  if (!section.introduction.empty()) html += "<p>" + escapeHtml(section.introduction) + "</p>\n";
  if (!section.figures.empty()) html += formatFigures(section.figures);
  if (!section.pictures.empty()) html += makePictures(section.pictures);
  for (const PageTable& table : section.tables) html += makeTable(table);
  return html + "</section>\n";
}

}  // namespace

std::string renderPage(const Page& page) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n";
  if (page.running) html += "<meta http-equiv=\"refresh\" content=\"4\">\n";
  html += "<title>" + escapeHtml(page.title) + "</title>\n<style>" + std::string(pageStyle()) +
          "</style></head>\n<body>\n<header><h1>" + escapeHtml(page.title) + "</h1><p class=\"subtitle\">" +
          escapeHtml(page.subtitle) + "</p>\n";
  if (page.running) {
    const int percent = static_cast<int>(100.0 * page.progress);
    html += "<div class=\"running\"><div class=\"bar\" style=\"width:" + std::to_string(percent) +
            "%\"></div><span>in progress" + (percent > 0 ? ", " + std::to_string(percent) + " %" : "") +
            "; this page refreshes itself</span></div>\n";
  }
  html += "<nav>";
  for (const Section& section : page.sections)
    html += "<a href=\"#" + section.id + "\">" + escapeHtml(section.title) + "</a>";
  html += "</nav></header>\n<main>\n" + makeTiles(page.tiles) + formatVerdicts(page.verdicts);
  for (const Section& section : page.sections) html += makeSection(section);
  return html + "</main>\n<footer>" + escapeHtml(page.footer) + "</footer>\n<script>" + pageScript() +
         "</script>\n</body></html>\n";
}

std::string base64(const std::vector<unsigned char>& bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned a = bytes[i], b = i + 1 < bytes.size() ? bytes[i + 1] : 0U,
                   c = i + 2 < bytes.size() ? bytes[i + 2] : 0U;
    text += kDigits[a >> 2U];
    text += kDigits[((a & 3U) << 4U) | (b >> 4U)];
    text += i + 1 < bytes.size() ? kDigits[((b & 15U) << 2U) | (c >> 6U)] : '=';
    text += i + 2 < bytes.size() ? kDigits[c & 63U] : '=';
  }
  return text;
}

}  // namespace urban_nav
