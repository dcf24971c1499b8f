// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "pipelines/report/canvas.hpp"

namespace tinyxml2 {
class XMLPrinter;
}

namespace brainshift::pipelines {

/// A straight line in a picture, pixels.
struct Segment {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

struct Stroke {
  Colour colour = colour::ink;
  double width = 1;  ///< pixels
};

/// Where the given position lies in the text.
enum class Anchor : std::uint8_t { left, centre, right };

struct TextStyle {
  int size = 14;  ///< pixels
  Colour fill = colour::ink;
  Anchor anchor = Anchor::left;
  bool bold = false;
  bool halo = false;  ///< a dark seam, for text on a picture
};

/// A picture as SVG text; what comes later lies above. Positions are in pixels from the upper left corner. tinyxml2
/// writes the elements, and escapes all text.
class Svg {
 public:
  /// name: the element's id; ids within the picture begin with it. label: what it shows, for those who cannot see it.
  Svg(const std::string& name, const std::string& label, int width, int height);
  Svg(Svg&&) noexcept;
  Svg& operator=(Svg&&) noexcept;
  ~Svg();

  /// Pixels, embedded as PNG, with their upper left corner at a place.
  void image(const Canvas& pixels, const Eigen::Vector2d& corner);
  void rectangle(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, const Colour& fill);
  /// Colours that pass into each other, evenly spaced from the lower side to the upper one.
  void gradient(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, std::span<const Colour> upwards);
  void lines(std::span<const Segment> segments, const Stroke& stroke);
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Stroke& stroke);
  void polyline(std::span<const Eigen::Vector2d> places, const Stroke& stroke);
  void dot(const Eigen::Vector2d& centre, double radius, const Colour& fill);
  /// One line of text, centred vertically on the position.
  void text(const Eigen::Vector2d& position, const std::string& words, const TextStyle& style);

  /// The whole picture: a file, or an element of a page.
  std::string str() &&;

 private:
  std::unique_ptr<tinyxml2::XMLPrinter> out_;
  std::string name_;
  int gradients_ = 0;
};

/// The three lines of an arrow with a head that suits the stroke's width; a mere line where it is shorter than a pixel.
std::vector<Segment> arrow(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width);

}  // namespace brainshift::pipelines
