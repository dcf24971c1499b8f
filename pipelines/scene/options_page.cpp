// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/options_page.hpp"

#include <sstream>

#include "pipelines/scene/read_sequence.hpp"
#include "pipelines/scene/scene_table.hpp"
#include "pipelines/scene/tissue_table.hpp"

namespace brainshift::pipelines {
namespace {

/// Breaks a text at blanks into lines of at most 120 characters; those after the first are indented.
std::string wrapped(const std::string& text, const std::string& indent) {
  constexpr std::size_t longest = 120;
  std::istringstream words(text);
  std::string lines, line;
  for (std::string word; words >> word;) {
    if (!line.empty() && line.size() + 1 + word.size() > longest) {
      lines += line + "\n";
      line = indent + word;
    } else {
      line += (line.empty() ? "" : " ") + word;
    }
  }
  return lines + line + "\n";
}

/// "a number > 0, mm; default 5".
std::string allowed_values(const std::string& allowed, const std::string& unit, bool is_required,
                           const std::string& value) {
  return allowed + (unit.empty() ? "" : ", " + unit) +
         (is_required     ? "; required"
          : value.empty() ? ""
                          : "; default " + value);
}

template <class T>
std::string list_of(const OptionTable<T>& table, const T& defaults) {
  std::string text;
  for (const Option<T>& option : table) {
    const std::string allowed = allowed_values(option.allowed, option.unit, option.required, option.get(defaults));
    text += wrapped("- `" + option.name + "`: " + option.help + ". [" + allowed + "]", "  ");
  }
  return text;
}

/// "<load><markups>" for load.markups.
std::string title(const Element& element) {
  if (is_stage(element.path)) {
    return "<stage name=\"" + element.path + "\">";
  }
  std::string tags = "<" + element.path + ">";
  if (const std::size_t dot = tags.find('.'); dot != std::string::npos) {
    tags.replace(dot, 1, "><");
  }
  return tags;
}

template <class T>
std::string section(const std::string& name, const std::string& help, const OptionTable<T>& table, const T& defaults) {
  return "\n## `" + name + "`\n" + wrapped(help, "") + "\n" + list_of(table, defaults);
}

}  // namespace

std::string options_page() {
  Scene everything;
  for (const Element& element : scene_elements()) {
    element.add(everything);
  }
  std::string text =
      "# Options of a scene\n" +
      wrapped(
          "This page is what `brainshift scene --options` prints. Each option is an attribute of its element. "
          "`--set PATH=VALUE` overrides one: the path is the element's with the option's name, as `image.t1`, "
          "`load.margin`, `tissues.1.density`, or for a stage its name, as `discretise.nodes`. File names are relative "
          "to "
          "the scene's file. In brackets stands what an option may be, its unit and its default. An element that is "
          "not built unless it is named may be left out, as may every option that "
          "is not required.",
          "");
  for (const Element& element : scene_elements()) {
    const std::string help = (element.optional ? "Not built unless it is named. " : "") + element.help;
    text += section(title(element), help, element.options, everything);
    if (element.path == "image") {
      text += section("<tissues><tissue>", "One element for each label of the brain.", tissue_options(), Tissue{});
    } else if (element.path == "cuts") {
      text += section("<cuts><cut>", "One element for each cut.", cut_options(), CutFile{});
    }
  }
  return text + "\n## `<sequence><state>`\n" +
         wrapped(
             "Not built unless it is named. An operation in order, one `<state name=\"...\">` each, which goes on from "
             "the one before it and holds the elements that it changes: " +
                 changeable_elements() +
                 ". An element takes the place of the one that was there; of a tissue only the attributes change that "
                 "are named; what is resected stays out. `--set sequence.STATE.PATH=VALUE` overrides an option of a "
                 "state and of those after it that do not change it themselves.",
             "");
}

}  // namespace brainshift::pipelines
