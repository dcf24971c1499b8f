// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "segmentation/options/values.hpp"

namespace brainshift {

/// One option, described once: how it is named, what it may be, how it is read into and written from the struct T that
/// holds it. Each stage has a table of them beside its struct (interface/option_table.hpp). Scenes, command lines, the
/// page of all options and the stage's own check read that table.
template <class T>
struct Option {
  std::string name;     ///< the XML attribute
  std::string allowed;  ///< "a number > 0", "linear | bspline", "a file"
  std::string unit;     ///< "mm"; empty for none
  std::string help;
  bool required = false;                ///< must be given where its element is
  bool is_path = false;                 ///< names a file, relative to the scene's
  std::vector<std::string> words = {};  ///< of a path: names that are taken in place of a file
  std::optional<Range> range = {};      ///< of an option that is one number
  /// From text. False, and the value as before, when the text is not of the option's kind: no number, none of the
  /// names. A number out of range is taken: holds() tells.
  std::function<bool(T&, const std::string&)> read;
  std::function<bool(const T&)> holds;  ///< whether the value is allowed
  std::function<std::string(const T&)> get;
};

template <class T>
using OptionTable = std::vector<Option<T>>;

/// Whether a value of the option is a file's name.
template <class T>
bool names_file(const Option<T>& option, const std::string& value) {
  return option.is_path && !value.empty() &&
         std::find(option.words.begin(), option.words.end(), value) == option.words.end();
}

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

/// What an access (a pointer to a member, or a function of a T or const T) leads to.
template <class T, class Access>
using Accessed = std::remove_cvref_t<std::invoke_result_t<Access, T&>>;

std::string refusal(const std::string& name, const std::string& value, const std::string& allowed,
                    const std::string& unit);

template <class Value>
using NamedValues = std::vector<std::pair<std::string, Value>>;

/// The name of a value, or null.
template <class Value>
const std::string* name_of(const NamedValues<Value>& names, const Value& value) {
  const auto found = std::find_if(names.begin(), names.end(), [&](const auto& named) { return named.second == value; });
  return found == names.end() ? nullptr : &found->first;
}

/// How a refusal writes a value without a name: as its number.
template <class Value>
std::string write_unnamed(const Value& value) {
  if constexpr (Unwrapped<Value>::optional) {
    return value ? write_number(*value) : "";
  } else {
    return write_number(static_cast<int>(value));
  }
}

}  // namespace detail

/// The sentence about a value that an option does not take: "nodes is '25', but must be a whole number from 30 to
/// 20000000".
template <class T>
std::string refusal(const Option<T>& option, const std::string& value) {
  return detail::refusal(option.name, value, option.allowed, option.unit);
}

/// Sets the option from text. False when it does not take the text; the target may then hold a value out of range.
template <class T>
bool set_option(const Option<T>& option, T& target, const std::string& text) {
  return option.read(target, text) && option.holds(target);
}

/// Throws std::invalid_argument with the refusal of the first option whose value is not allowed.
template <class T>
void check_table(const OptionTable<T>& table, const T& options) {
  for (const Option<T>& option : table) {
    if (!option.holds(options)) {
      throw std::invalid_argument(refusal(option, option.get(options)));
    }
  }
}

template <class T>
const Option<T>* find_option(const OptionTable<T>& table, const std::string& name) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const auto& option) { return option.name == name; });
  return found == table.end() ? nullptr : &*found;
}

/// "name, name, name".
template <class T>
std::string option_names(const OptionTable<T>& table) {
  std::string names;
  for (const auto& option : table) {
    names += (names.empty() ? "" : ", ") + option.name;
  }
  return names.empty() ? "none" : names;
}

/// Of a number, or of a number that may be absent. T cannot be deduced from an access that is a function.
template <class T, class Access>
Option<T> number_option(std::string name, Access access, Range range, std::string unit, std::string help) {
  using Stored = detail::Accessed<T, Access>;
  using Value = typename detail::Unwrapped<Stored>::type;
  constexpr bool optional = detail::Unwrapped<Stored>::optional;
  const auto read = [access](T& target, const std::string& text) {
    if (optional && text.empty()) {
      std::invoke(access, target) = Stored{};
      return true;
    }
    const auto value = read_number<Value>(text);
    if (value) {
      std::invoke(access, target) = *value;
    }
    return value.has_value();
  };
  const auto holds = [access, range](const T& target) {
    if constexpr (optional) {
      const Stored& value = std::invoke(access, target);
      return !value || range.holds(static_cast<double>(*value));
    } else {
      return range.holds(static_cast<double>(std::invoke(access, target)));
    }
  };
  const auto get = [access](const T& target) -> std::string {
    if constexpr (optional) {
      const Stored& value = std::invoke(access, target);
      return value ? write_number(*value) : "";
    } else {
      return write_number(std::invoke(access, target));
    }
  };
  return {.name = std::move(name),
          .allowed = allowed_numbers(std::is_integral_v<Value> ? "a whole number" : "a number", range) +
                     (optional ? ", or nothing" : ""),
          .unit = std::move(unit),
          .help = std::move(help),
          .range = range,
          .read = read,
          .holds = holds,
          .get = get};
}

template <class T, class Access>
Option<T> text_option(std::string name, Access access, std::string help) {
  return {.name = std::move(name),
          .allowed = "text",
          .unit = "",
          .help = std::move(help),
          .read =
              [access](T& target, const std::string& text) {
                std::invoke(access, target) = text;
                return true;
              },
          .holds = [](const T&) { return true; },
          .get = [access](const T& target) { return std::string(std::invoke(access, target)); }};
}

template <class T, class Access>
Option<T> file_option(std::string name, Access access, std::string help) {
  Option<T> option = text_option<T>(std::move(name), access, std::move(help));
  option.allowed = "a file";
  option.is_path = true;
  return option;
}

/// A file, or one of some names in its place.
template <class T, class Access>
Option<T> named_file_option(std::string name, Access access, std::vector<std::string> words, std::string help) {
  Option<T> option = file_option<T>(std::move(name), access, std::move(help));
  option.allowed.clear();
  for (const std::string& word : words) {
    option.allowed += word + " | ";
  }
  option.allowed += "a file";
  option.words = std::move(words);
  return option;
}

/// One of some values that have names: of an enumeration, most often.
template <class T, class Access>
Option<T> choice_option(std::string name, Access access, detail::NamedValues<detail::Accessed<T, Access>> names,
                        std::string help) {
  std::string allowed;
  for (const auto& [word, value] : names) {
    allowed += (allowed.empty() ? "" : " | ") + word;
  }
  const auto read = [access, names](T& target, const std::string& wanted) {
    for (const auto& [word, value] : names) {
      if (word == wanted) {
        std::invoke(access, target) = value;
        return true;
      }
    }
    return false;
  };
  const auto get = [access, names](const T& target) {
    const std::string* word = detail::name_of(names, std::invoke(access, target));
    return word != nullptr ? *word : detail::write_unnamed(std::invoke(access, target));
  };
  return {.name = std::move(name),
          .allowed = std::move(allowed),
          .unit = "",
          .help = std::move(help),
          .read = read,
          .holds = [access,
                    names](const T& target) { return detail::name_of(names, std::invoke(access, target)) != nullptr; },
          .get = get};
}

/// A list of labels.
template <class T, class Access>
Option<T> labels_option(std::string name, Access access, std::string help) {
  using Value = typename detail::Accessed<T, Access>::value_type;
  const auto read = [access](T& target, const std::string& words) {
    auto values = read_numbers<Value>(words);
    if (values) {
      std::invoke(access, target) = std::move(*values);
    }
    return values.has_value();
  };
  const auto holds = [access](const T& target) {
    const auto& values = std::invoke(access, target);
    return std::all_of(values.begin(), values.end(), [](Value v) { return label_numbers.holds(v); });
  };
  return {.name = std::move(name),
          .allowed = allowed_numbers("whole numbers", label_numbers) + ", separated by blanks",
          .unit = "",
          .help = std::move(help),
          .read = read,
          .holds = holds,
          .get = [access](const T& target) { return write_numbers(std::invoke(access, target)); }};
}

/// A list of labels, in which "10-13" is 10 11 12 13.
template <class T, class Access>
Option<T> label_ranges_option(std::string name, Access access, std::string help) {
  Option<T> option = labels_option<T>(std::move(name), access, std::move(help));
  option.allowed += "; 10-13 is 10 11 12 13";
  option.read = [access](T& target, const std::string& words) {
    const auto values = read_ranges(words);
    if (values) {
      std::invoke(access, target).assign(values->begin(), values->end());
    }
    return values.has_value();
  };
  return option;
}

/// A vector of the world, three numbers, or one that may be absent.
template <class T, class Access>
Option<T> vector_option(std::string name, Access access, std::string unit, std::string help) {
  using Stored = detail::Accessed<T, Access>;
  constexpr bool optional = detail::Unwrapped<Stored>::optional;
  const auto read = [access](T& target, const std::string& words) {
    if (optional && words.empty()) {
      std::invoke(access, target) = Stored{};
      return true;
    }
    const auto values = read_numbers<double>(words);
    if (!values || values->size() != 3) {
      return false;
    }
    std::invoke(access, target) = Eigen::Vector3d((*values)[0], (*values)[1], (*values)[2]);
    return true;
  };
  /// The vector, or null.
  const auto given = [access](const T& target) -> const Eigen::Vector3d* {
    const Stored& stored = std::invoke(access, target);
    if constexpr (optional) {
      return stored ? &*stored : nullptr;
    } else {
      return &stored;
    }
  };
  return {.name = std::move(name),
          .allowed = optional ? "three numbers, or nothing" : "three numbers",
          .unit = std::move(unit),
          .help = std::move(help),
          .read = read,
          .holds = [given](const T& target) { return given(target) == nullptr || given(target)->allFinite(); },
          .get = [given](const T& target) { return given(target) ? write_numbers(*given(target)) : ""; }};
}

/// A list of pairs of numbers, kept as structs of two: "a,b; a,b".
template <class T, class Access>
Option<T> pairs_option(std::string name, Access access, std::string allowed, std::string unit, std::string help) {
  using Pair = typename detail::Accessed<T, Access>::value_type;
  const auto read = [access](T& target, const std::string& words) {
    const auto values = read_number_pairs(words);
    if (values) {
      auto& list = std::invoke(access, target);
      list.clear();
      for (const auto& [first, second] : *values) {
        list.push_back(Pair{first, second});
      }
    }
    return values.has_value();
  };
  const auto holds = [access](const T& target) {
    const auto& list = std::invoke(access, target);
    return std::all_of(list.begin(), list.end(), [](const Pair& pair) {
      const auto& [first, second] = pair;
      return any_number.holds(first) && any_number.holds(second);
    });
  };
  const auto get = [access](const T& target) {
    std::string words;
    for (const auto& [first, second] : std::invoke(access, target)) {
      words += (words.empty() ? "" : "; ") + write_number(first) + "," + write_number(second);
    }
    return words;
  };
  return {.name = std::move(name),
          .allowed = std::move(allowed),
          .unit = std::move(unit),
          .help = std::move(help),
          .read = read,
          .holds = holds,
          .get = get};
}

template <class T>
Option<T> required(Option<T> option) {
  option.required = true;
  return option;
}

/// An option of a part as one of the whole that holds it. `part` leads from the whole to the part.
template <class Whole, class Part, class Access>
Option<Whole> of_whole(const Option<Part>& option, Access part) {
  return {.name = option.name,
          .allowed = option.allowed,
          .unit = option.unit,
          .help = option.help,
          .required = option.required,
          .is_path = option.is_path,
          .words = option.words,
          .range = option.range,
          .read = [read = option.read, part](Whole& whole,
                                             const std::string& text) { return read(std::invoke(part, whole), text); },
          .holds = [holds = option.holds, part](const Whole& whole) { return holds(std::invoke(part, whole)); },
          .get = [get = option.get, part](const Whole& whole) { return get(std::invoke(part, whole)); }};
}

template <class Whole, class Part, class Access>
OptionTable<Whole> of_whole(const OptionTable<Part>& table, Access part) {
  OptionTable<Whole> result;
  for (const Option<Part>& option : table) {
    result.push_back(of_whole<Whole>(option, part));
  }
  return result;
}

/// Appends a table to another.
template <class T>
void append(OptionTable<T>& table, OptionTable<T> more) {
  std::move(more.begin(), more.end(), std::back_inserter(table));
}

}  // namespace brainshift
