// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "segmentation/files/lower_case.hpp"
#include "segmentation/files/readable_file.hpp"
#include "segmentation/files/text_lines.hpp"
#include "segmentation/image/segments.hpp"
#include "segmentation/interface/options.hpp"
#include "segmentation/labels/label_table.hpp"
#include "segmentation/options/values.hpp"

namespace brainshift::segmentation {
namespace {

namespace fs = std::filesystem;

bool is_upper(char letter) {
  return std::isupper(static_cast<unsigned char>(letter)) != 0;
}

bool is_lower(char letter) {
  return std::islower(static_cast<unsigned char>(letter)) != 0;
}

// The runs of letters in a name, as they are written.
std::vector<std::string> parts_of(const std::string& name) {
  std::vector<std::string> parts(1);
  for (const char letter : name) {
    if (std::isalpha(static_cast<unsigned char>(letter)) != 0) {
      parts.back() += letter;
    } else if (!parts.back().empty()) {
      parts.emplace_back();
    }
  }
  if (parts.back().empty()) {
    parts.pop_back();
  }
  return parts;
}

// Whether another word begins there, not at the first letter: in "LateralVentricles" at V, in "CSFSpace" at its last S.
bool begins_word(const std::string& part, std::size_t at) {
  return is_upper(part[at]) && (is_lower(part[at - 1]) || (at + 1 < part.size() && is_lower(part[at + 1])));
}

// The words of "Left-Inf-Lat-Vent", "ctx_lh_G_oc-temp" or "LateralVentricles", in lower case; of what capitals part,
// the whole, too: "ExtraCerebral".
std::vector<std::string> words_of(const std::string& name) {
  std::vector<std::string> words;
  for (const std::string& part : parts_of(name)) {
    words.push_back(in_lower_case(part));
    std::size_t from = 0;
    for (std::size_t at = 1; at <= part.size(); ++at) {
      const bool ends = at == part.size() ? from > 0 : begins_word(part, at);
      if (ends) {
        words.push_back(in_lower_case(part.substr(from, at - from)));
        from = at;
      }
    }
  }
  return words;
}

// A row of the table: the number and the name, or nothing.
struct Row {
  std::string number;
  std::string name;
};

std::vector<std::string> split_at_tabs(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char letter : line) {
    if (letter == '\t') {
      fields.emplace_back();
    } else {
      fields.back() += letter;
    }
  }
  for (std::string& field : fields) {
    field = std::string(trimmed(field));
  }
  return fields;
}

// Columns of a tab-separated table with the header `index` and `name`, or FastSurfer's `ID` and `LabelName`.
struct Columns {
  std::size_t index;
  std::size_t name;
};

std::optional<Columns> columns_of(const std::string& header) {
  const auto fields = split_at_tabs(header);
  const auto column = [&](const char* of_bids, const char* of_fastsurfer) {
    const auto found = std::find(fields.begin(), fields.end(), of_bids);
    return found != fields.end() ? found : std::find(fields.begin(), fields.end(), of_fastsurfer);
  };
  const auto index = column("index", "ID"), name = column("name", "LabelName");
  if (index == fields.end() || name == fields.end()) {
    return std::nullopt;
  }
  return Columns{static_cast<std::size_t>(index - fields.begin()), static_cast<std::size_t>(name - fields.begin())};
}

Row row_of(const std::string& line, const std::optional<Columns>& columns) {
  if (columns) {
    const auto fields = split_at_tabs(line);
    const std::size_t last = std::max(columns->index, columns->name);
    return last < fields.size() ? Row{fields[columns->index], fields[columns->name]} : Row{};
  }
  Row row;
  std::istringstream words(line);
  words >> row.number;
  if (const std::size_t quote = line.find('"'); quote != std::string::npos) {  // the last column of ITK-SNAP's
    row.name = line.substr(quote + 1, line.find('"', quote + 1) - quote - 1);
    return row;
  }
  const auto is_colour = [](const std::string& word) {  // behind the name; "Inf" of "Left Inf Lat Vent" is none
    return std::isdigit(static_cast<unsigned char>(word.back())) != 0 && read_number<double>(word).has_value();
  };
  for (std::string word; words >> word && !is_colour(word);) {
    row.name += (row.name.empty() ? "" : " ") + word;
  }
  return row;
}

bool has_letter(const std::string& name) {
  return std::any_of(name.begin(), name.end(), [](unsigned char c) { return std::isalpha(c) != 0 || c >= 0x80; });
}

// first_lines: of each number, the line that names it first.
void add_row(LabelTable& table, const Row& row, const fs::path& file, std::size_t line,
             std::map<int, std::size_t>& first_lines) {
  const auto number = read_number<int>(trimmed(row.number));
  if (!number || !has_letter(row.name)) {
    fail_at_line(file, line,
                 "a label's number and its name are expected, as '10 Left-Thalamus', ITK-SNAP's form with the name "
                 "in quotes at the end, or columns 'index' and 'name'");
  }
  if (*number < 0 || *number > static_cast<int>(label_numbers.high)) {
    return;  // a list of colours names numbers that no label map of ours holds
  }
  if (const auto known = first_lines.emplace(*number, line); !known.second) {
    fail_at_line(file, line,
                 "names the number " + std::to_string(*number) + ", which line " + std::to_string(known.first->second) +
                     " names already; keep one of the two");
  }
  table.classes[static_cast<std::uint16_t>(*number)] = *number == 0 ? std::uint16_t{0} : class_of_name(row.name);
}

LabelTable table_of_segments(const fs::path& file) {
  LabelTable table{"those of " + file.string(), {}};
  for (const Segment& segment : read_segments(file)) {
    const std::uint16_t tissue = class_of_name(segment.name);
    if (const auto known = table.classes.emplace(segment.label, tissue); known.first->second != tissue) {
      refuse(file, "its segments give the number " + std::to_string(segment.label) +
                       " to different tissues, in layers that overlap; name it as the label map, not as a table");
    }
  }
  if (table.classes.empty()) {
    refuse(file, "its header names no segment, as 3D Slicer's .seg.nrrd does; give another table");
  }
  return table;
}

}  // namespace

std::uint16_t class_of_name(const std::string& name) {
  struct Words {
    std::uint16_t tissue;
    std::vector<std::string_view> words;
  };
  // The first group with a word of the name counts.
  static const Words groups[] = {
      {default_label::parenchyma, {"stripped", "ctx"}},  // "skull-stripped brain", "ctx-lh-unknown"
      {0, {"background", "unknown", "exterior"}},
      {default_label::tumour,
       {"tumor", "tumors", "tumour", "tumours", "glioma", "gliomas", "metastasis", "metastases", "meningioma",
        "meningiomas", "glioblastoma", "gbm", "gtv", "mass", "enhancing", "necrosis"}},
      // "frontal eye field", "premotor eye fields", "fusiform face complex"
      {default_label::parenchyma, {"field", "fields", "fusiform"}},
      {0, {"air", "skin", "scalp", "eye", "eyes", "face", "mandible", "dura", "muscle", "fat"}},
      {default_label::skull, {"skull", "bone", "cranium", "calvarium"}},
      {default_label::ventricles, {"ventricle", "ventricles", "ventricular", "vent", "choroid"}},
      {default_label::csf, {"csf", "fluid", "cerebrospinal"}},
      {0, {"extracerebral"}}};
  const auto in_name = words_of(name);
  if (in_name == std::vector<std::string>{"head"}) {  // not that of the hippocampus
    return 0;
  }
  for (const auto& [tissue, words] : groups) {
    if (std::ranges::find_first_of(in_name, words) != in_name.end()) {
      return tissue;
    }
  }
  return default_label::parenchyma;
}

bool name_tells_class(const std::string& name) {
  const auto parts = parts_of(name);
  return !parts.empty() && in_lower_case(parts.front()) != "segment";
}

LabelTable read_label_table(const fs::path& file) {
  check_readable(file);
  if (ending_of(file) == ".nrrd") {
    return table_of_segments(file);
  }
  const auto lines = read_lines(file);
  const auto says = [&](std::size_t i) { return !trimmed(lines[i]).empty() && trimmed(lines[i]).front() != '#'; };
  std::size_t line = 0;
  while (line < lines.size() && !says(line)) {
    ++line;
  }
  const auto columns = line < lines.size() ? columns_of(lines[line]) : std::nullopt;
  LabelTable table{"those of " + file.string(), {}};
  std::map<int, std::size_t> first_lines;
  for (line += columns ? 1 : 0; line < lines.size(); ++line) {
    if (says(line)) {
      add_row(table, row_of(lines[line], columns), file, line + 1, first_lines);
    }
  }
  if (table.classes.empty()) {
    refuse(file,
           "names no label; lines 'number name', or columns 'index' and 'name' (or 'ID' and 'LabelName'), are "
           "expected");
  }
  return table;
}

}  // namespace brainshift::segmentation
