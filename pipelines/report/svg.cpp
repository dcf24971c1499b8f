// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/svg.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cstdio>

namespace brainshift::pipelines {

namespace {

using Eigen::Vector2d;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return text;
}

std::string hex(const Colour& colour) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", colour[0], colour[1], colour[2]);
  return text;
}

void set(tinyxml2::XMLPrinter& out, const char* name, const std::string& value) {
  out.PushAttribute(name, value.c_str());
}

void set(tinyxml2::XMLPrinter& out, const char* name, double value) {
  set(out, name, number(value));
}

void set_box(tinyxml2::XMLPrinter& out, const Vector2d& corner, const Vector2d& size) {
  set(out, "x", corner.x());
  set(out, "y", corner.y());
  set(out, "width", size.x());
  set(out, "height", size.y());
}

std::string pair(const Vector2d& place) {
  return number(place.x()) + " " + number(place.y());
}

void add_path(tinyxml2::XMLPrinter& out, const std::string& path, const Stroke& stroke) {
  out.OpenElement("path");
  set(out, "d", path);
  set(out, "fill", "none");
  set(out, "stroke", hex(stroke.colour));
  set(out, "stroke-width", stroke.width);
  set(out, "stroke-linecap", "round");
  set(out, "stroke-linejoin", "round");
  out.CloseElement();
}

}  // namespace

Svg::Svg(const std::string& name, const std::string& label, int width, int height)
    : out_(std::make_unique<tinyxml2::XMLPrinter>()), name_(name) {
  out_->OpenElement("svg");
  set(*out_, "xmlns", "http://www.w3.org/2000/svg");
  set(*out_, "id", name);
  set(*out_, "width", width);
  set(*out_, "height", height);
  set(*out_, "viewBox", "0 0 " + std::to_string(width) + " " + std::to_string(height));
  set(*out_, "role", "img");
  set(*out_, "aria-label", label);
  set(*out_, "font-family", "sans-serif");
}

Svg::Svg(Svg&&) noexcept = default;
Svg& Svg::operator=(Svg&&) noexcept = default;
Svg::~Svg() = default;

void Svg::image(const Canvas& pixels, const Vector2d& corner) {
  out_->OpenElement("image");
  set_box(*out_, corner, {pixels.width, pixels.height});
  set(*out_, "href", "data:image/png;base64," + encode_base64(encode_png(pixels)));
  out_->CloseElement();
}

void Svg::rectangle(const Vector2d& corner, const Vector2d& size, const Colour& fill) {
  out_->OpenElement("rect");
  set_box(*out_, corner, size);
  set(*out_, "fill", hex(fill));
  out_->CloseElement();
}

void Svg::gradient(const Vector2d& corner, const Vector2d& size, std::span<const Colour> upwards) {
  const std::string id = name_ + "_gradient" + std::to_string(gradients_++);
  out_->OpenElement("linearGradient");
  set(*out_, "id", id);
  set(*out_, "x1", 0);
  set(*out_, "x2", 0);
  set(*out_, "y1", 1);
  set(*out_, "y2", 0);
  for (std::size_t i = 0; i < upwards.size(); ++i) {
    out_->OpenElement("stop");
    set(*out_, "offset", static_cast<double>(i) / static_cast<double>(upwards.size() - 1));
    set(*out_, "stop-color", hex(upwards[i]));
    out_->CloseElement();
  }
  out_->CloseElement();
  out_->OpenElement("rect");
  set_box(*out_, corner, size);
  set(*out_, "fill", "url(#" + id + ")");
  out_->CloseElement();
}

void Svg::lines(std::span<const Segment> segments, const Stroke& stroke) {
  std::string path;
  for (const Segment& segment : segments) {
    path += "M" + pair(segment.from) + "L" + pair(segment.to);
  }
  if (!path.empty()) {
    add_path(*out_, path, stroke);
  }
}

void Svg::line(const Vector2d& from, const Vector2d& to, const Stroke& stroke) {
  lines(std::array{Segment{from, to}}, stroke);
}

void Svg::polyline(std::span<const Vector2d> places, const Stroke& stroke) {
  std::string path;
  for (const Vector2d& place : places) {
    path += (path.empty() ? "M" : "L") + pair(place);
  }
  if (!path.empty()) {
    add_path(*out_, path, stroke);
  }
}

void Svg::dot(const Vector2d& centre, double radius, const Colour& fill) {
  out_->OpenElement("circle");
  set(*out_, "cx", centre.x());
  set(*out_, "cy", centre.y());
  set(*out_, "r", radius);
  set(*out_, "fill", hex(fill));
  out_->CloseElement();
}

void Svg::text(const Vector2d& position, const std::string& words, const TextStyle& style) {
  constexpr std::array<const char*, 3> anchors = {"start", "middle", "end"};
  out_->OpenElement("text");
  set(*out_, "x", position.x());
  set(*out_, "y", position.y());
  set(*out_, "dy", "0.35em");  // half the height of a capital: centred, in every viewer
  set(*out_, "font-size", style.size);
  set(*out_, "text-anchor", anchors[static_cast<std::size_t>(style.anchor)]);
  set(*out_, "fill", hex(style.fill));
  if (style.bold) {
    set(*out_, "font-weight", "bold");
  }
  if (style.halo) {
    set(*out_, "stroke", hex(colour::black));
    set(*out_, "stroke-width", 3);
    set(*out_, "stroke-opacity", 0.6);
    set(*out_, "paint-order", "stroke");
  }
  out_->PushText(words.c_str());
  out_->CloseElement();
}

std::string Svg::str() && {
  out_->CloseElement();
  return out_->CStr();
}

std::vector<Segment> arrow(const Vector2d& from, const Vector2d& to, double width) {
  std::vector<Segment> lines = {{from, to}};
  const double length = (to - from).norm();
  if (length < 1) {
    return lines;
  }
  const Vector2d along = (to - from) / length;
  const Vector2d across(-along.y(), along.x());
  const double head = std::min(0.45 * length, 3.5 * width + 2);
  for (const double side : {-0.5, 0.5}) {
    lines.push_back({to, to - head * along + side * head * across});
  }
  return lines;
}

}  // namespace brainshift::pipelines
