// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "pipelines/scene/values.hpp"

namespace brainshift::pipelines {

/// One option of a scene, described once: how it is named, what it may be, how it is read into and written from the
/// struct T that holds it.
template <class T>
struct Option {
  std::string name;     ///< the XML attribute
  std::string allowed;  ///< "a number > 0", "linear | bspline", "a file"
  std::string unit;     ///< "mm"; empty for none
  std::string help;
  bool required = false;  ///< must be given where its element is
  bool is_path = false;   ///< names a file, relative to the scene's
  /// From text; false when the text is not allowed.
  std::function<bool(T&, const std::string&)> set;
  std::function<std::string(const T&)> get;
};

namespace detail {
template <class T>
struct Unwrapped {
  using type = T;
  static constexpr bool optional = false;
};
template <class T>
struct Unwrapped<std::optional<T>> {
  using type = T;
  static constexpr bool optional = true;
};
}  // namespace detail

/// The accessors below take T& or const T& and return a reference to the value inside.
template <class T, class Access>
Option<T> number(std::string name, Access access, Range range, std::string unit, std::string help) {
  using Stored = std::remove_cvref_t<decltype(access(std::declval<T&>()))>;
  using Value = typename detail::Unwrapped<Stored>::type;
  constexpr bool optional = detail::Unwrapped<Stored>::optional;
  Option<T> option{std::move(name),
                   describe(range, std::is_integral_v<Value>),
                   std::move(unit),
                   std::move(help),
                   false,
                   false,
                   {},
                   {}};
  if (optional) {
    option.allowed += ", or nothing";
  }
  option.set = [=](T& target, const std::string& text) {
    if (optional && text.empty()) {
      access(target) = Stored{};
      return true;
    }
    const auto value = read_number<Value>(text, range);
    if (value) {
      access(target) = *value;
    }
    return value.has_value();
  };
  option.get = [=](const T& target) -> std::string {
    if constexpr (optional) {
      return access(target) ? write_number(*access(target)) : "";
    } else {
      return write_number(access(target));
    }
  };
  return option;
}

template <class T, class Access>
Option<T> file(std::string name, Access access, std::string help) {
  return {std::move(name),
          "a file",
          "",
          std::move(help),
          false,
          true,
          [=](T& target, const std::string& text) {
            access(target) = text;
            return true;
          },
          [=](const T& target) { return std::string(access(target)); }};
}

template <class T, class Access>
Option<T> text(std::string name, Access access, std::string help) {
  Option<T> option = file<T>(std::move(name), access, std::move(help));
  option.allowed = "text";
  option.is_path = false;
  return option;
}

template <class T, class Access, class Enum>
Option<T> choice(std::string name, Access access, std::vector<std::pair<std::string, Enum>> names, std::string help) {
  Option<T> option{std::move(name), "", "", std::move(help), false, false, {}, {}};
  for (const auto& [word, value] : names) {
    option.allowed += (option.allowed.empty() ? "" : " | ") + word;
  }
  option.set = [=](T& target, const std::string& wanted) {
    for (const auto& [word, value] : names) {
      if (word == wanted) {
        access(target) = value;
        return true;
      }
    }
    return false;
  };
  option.get = [=](const T& target) -> std::string {
    for (const auto& [word, value] : names) {
      if (access(target) == value) {
        return word;
      }
    }
    throw std::logic_error("an enumerator of option " + option.name + " has no name");
  };
  return option;
}

/// A list of whole numbers.
template <class T, class Access>
Option<T> labels(std::string name, Access access, std::string help) {
  using Value = typename std::remove_cvref_t<decltype(access(std::declval<T&>()))>::value_type;
  return {std::move(name),
          "whole numbers from 1 to 32767, separated by blanks",
          "",
          std::move(help),
          false,
          false,
          [=](T& target, const std::string& words) {
            auto values = read_numbers<Value>(words, {.low = 1, .high = 32767});
            if (values) {
              access(target) = std::move(*values);
            }
            return values.has_value();
          },
          [=](const T& target) { return write_numbers(access(target)); }};
}

/// A vector of the world, three numbers.
template <class T, class Access>
Option<T> vector(std::string name, Access access, std::string unit, std::string help) {
  return {std::move(name),
          "three numbers",
          std::move(unit),
          std::move(help),
          false,
          false,
          [=](T& target, const std::string& words) {
            const auto values = read_numbers<double>(words, {});
            if (!values || values->size() != 3) {
              return false;
            }
            access(target) = Eigen::Vector3d((*values)[0], (*values)[1], (*values)[2]);
            return true;
          },
          [=](const T& target) { return write_numbers(access(target)); }};
}

/// A list of pairs of numbers, kept as structs of two: "a,b; a,b".
template <class T, class Access>
Option<T> pairs(std::string name, Access access, std::string allowed, std::string unit, std::string help) {
  using Pair = typename std::remove_cvref_t<decltype(access(std::declval<T&>()))>::value_type;
  return {std::move(name),
          std::move(allowed),
          std::move(unit),
          std::move(help),
          false,
          false,
          [=](T& target, const std::string& words) {
            const auto values = read_number_pairs(words);
            if (values) {
              access(target).clear();
              for (const auto& [first, second] : *values) {
                access(target).push_back(Pair{first, second});
              }
            }
            return values.has_value();
          },
          [=](const T& target) {
            std::string words;
            for (const auto& [first, second] : access(target)) {
              words += (words.empty() ? "" : "; ") + write_number(first) + "," + write_number(second);
            }
            return words;
          }};
}

template <class T>
Option<T> required(Option<T> option) {
  option.required = true;
  return option;
}

}  // namespace brainshift::pipelines
