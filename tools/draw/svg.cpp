#include "draw/svg.h"

#include <charconv>
#include <cmath>
#include <fstream>

namespace draw {

namespace {

constexpr double units = 20;  // a pixel

void append(std::string& text, long number) {
  char digits[24];
  const std::to_chars_result end = std::to_chars(digits, digits + sizeof digits, number);
  text.append(digits, end.ptr);
}

std::string in_units(double pixels) {
  std::string text;
  append(text, std::lround(pixels * units));
  return text;
}

std::string hundredths(double value) {
  const long whole = std::lround(value * 100);
  std::string text;
  append(text, whole / 100);
  text += '.';
  if (whole % 100 < 10) text += '0';
  append(text, whole % 100);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

}  // namespace

PathData::Point PathData::rounded(Vec2 p) { return {std::lround(p.x * units), std::lround(p.y * units)}; }

/// The command's letter is left out where the one before goes on.
void PathData::put(char command, Point p) {
  const bool goes_on = command == 'l' && (last_ == 'l' || last_ == 'm');
  if (!goes_on) text_ += command;
  const long x = p.x - pen_.x, y = p.y - pen_.y;
  if (goes_on && x >= 0) text_ += ' ';
  append(text_, x);
  if (y >= 0) text_ += ' ';
  append(text_, y);
  pen_ = p;
  last_ = command;
}

void PathData::move_to(Vec2 p) {
  put('m', rounded(p));  // the first counts from the origin
  start_ = pen_;
}

void PathData::line_to(Vec2 p) { put('l', rounded(p)); }

void PathData::close() {
  text_ += 'z';
  pen_ = start_;
  last_ = 'z';
}

void PathData::spot(Vec2 p) {
  move_to(p);
  text_ += "h1";
  ++pen_.x;
  last_ = 'h';
}

void PathData::triangle(Vec2 a, Vec2 b, Vec2 c) {
  move_to(a);
  line_to(b);
  line_to(c);
  close();
}

void PathData::segment(Vec2 a, Vec2 b) {
  const Point from = rounded(a);
  if (last_ != 'l' || from.x != pen_.x || from.y != pen_.y) move_to(a);
  line_to(b);
}

void Svg::open_box(Vec2 corner, double width, double height) {
  text_ += "<svg x=\"" + in_units(corner.x) + "\" y=\"" + in_units(corner.y) + "\" width=\"" + in_units(width) +
           "\" height=\"" + in_units(height) + "\">\n";
}

void Svg::close_box() { text_ += "</svg>\n"; }

void Svg::path(const PathData& data, const PathStyle& style) {
  if (data.empty()) return;
  text_ += "<path";
  if (style.filled) text_ += " fill=\"" + hex(style.fill) + "\"";
  if (style.width > 0) text_ += " stroke=\"" + hex(style.stroke) + "\" stroke-width=\"" + in_units(style.width) + "\"";
  if (style.opacity < 1) text_ += " opacity=\"" + hundredths(style.opacity) + "\"";
  text_ += " d=\"" + data.text() + "\"/>\n";
}

void Svg::text(Vec2 p, double size, Colour colour, const std::string& text, Anchor anchor) {
  text_ += "<text x=\"" + in_units(p.x) + "\" y=\"" + in_units(p.y) + "\" font-size=\"" + in_units(size) + "\"";
  if (anchor != Anchor::start) {
    text_ += std::string(" text-anchor=\"") + (anchor == Anchor::middle ? "middle" : "end") + "\"";
  }
  text_ += " fill=\"" + hex(colour) + "\">" + escaped(text) + "</text>\n";
}

bool Svg::write(const std::string& file) const {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  const std::string w = in_units(width_), h = in_units(height_);
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << std::lround(width_) << "\" height=\""
      << std::lround(height_) << "\" viewBox=\"0 0 " << w << " " << h
      << "\" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\" "
         "font-family=\"Helvetica Neue,Helvetica,Arial,Liberation Sans,DejaVu Sans,sans-serif\">\n<path fill=\""
      << hex(palette::paper) << "\" d=\"M0 0H" << w << "V" << h << "H0z\"/>\n";
  out << text_ << "</svg>\n";
  out.close();
  return !out.fail();
}

}  // namespace draw
