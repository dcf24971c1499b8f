// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/page_template.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

namespace brainshift::pipelines {

namespace {

using nlohmann::json;
using tinyxml2::XMLElement;
using tinyxml2::XMLNode;

const std::string& text_of(const json& data, const std::string& name) {
  const auto value = data.find(name);
  if (value == data.end() || !value->is_string()) {
    throw std::logic_error("the page shows {{" + name + "}}, which its data do not have");
  }
  return value->get_ref<const std::string&>();
}

std::string filled(const std::string& text, const json& data) {
  std::string result;
  std::size_t done = 0;
  for (std::size_t open = text.find("{{"); open != std::string::npos; open = text.find("{{", done)) {
    const std::size_t close = text.find("}}", open);
    if (close == std::string::npos) {
      throw std::logic_error("the page has {{ without }}: " + text.substr(open, 40));
    }
    result += text.substr(done, open - done) + text_of(data, text.substr(open + 2, close - open - 2));
    done = close + 2;
  }
  return result + text.substr(done);
}

void parse(tinyxml2::XMLDocument& document, const char* text) {
  if (document.Parse(text) != tinyxml2::XML_SUCCESS) {
    throw std::logic_error(std::string("the page is not well-formed: ") + document.ErrorStr());
  }
}

void replace_by_picture(XMLElement& place, const json& data) {
  tinyxml2::XMLDocument picture;
  parse(picture, text_of(data, place.Attribute("svg")).c_str());
  place.Parent()->InsertAfterChild(&place, picture.RootElement()->DeepClone(place.GetDocument()));
  place.Parent()->DeleteChild(&place);
}

void fill(XMLElement& element, const json& data);

void repeat(XMLElement& pattern, const json& data) {
  const std::string name = pattern.Attribute("each");
  pattern.DeleteAttribute("each");
  const json items = data.value(name, json(false));
  XMLNode* last = &pattern;
  const auto add = [&](const json& item) {
    XMLNode* const copy = pattern.DeepClone(pattern.GetDocument());
    last = pattern.Parent()->InsertAfterChild(last, copy);
    fill(*copy->ToElement(), item);
  };
  if (items.is_array()) {
    std::ranges::for_each(items, add);
  } else if (items.is_object()) {
    add(items);
  } else if (items.get<bool>()) {
    add(data);
  }
  pattern.Parent()->DeleteChild(&pattern);
}

void fill(XMLElement& element, const json& data) {
  for (const auto* attribute = element.FirstAttribute(); attribute != nullptr; attribute = attribute->Next()) {
    element.SetAttribute(attribute->Name(), filled(attribute->Value(), data).c_str());
  }
  for (XMLNode *child = element.FirstChild(), *next = nullptr; child != nullptr; child = next) {
    next = child->NextSibling();
    XMLElement* const inner = child->ToElement();
    if (child->ToComment() != nullptr) {
      element.DeleteChild(child);
    } else if (inner == nullptr) {
      child->SetValue(filled(child->Value(), data).c_str());
    } else if (inner->Attribute("each") != nullptr) {
      repeat(*inner, data);
    } else if (inner->Attribute("svg") != nullptr) {
      replace_by_picture(*inner, data);
    } else {
      fill(*inner, data);
    }
  }
}

// As HTML wants it: elements that are empty by nature have no end tag, all others have one.
class HtmlPrinter : public tinyxml2::XMLPrinter {
 public:
  bool VisitExit(const XMLElement& element) override {
    constexpr std::array<std::string_view, 3> empty_by_nature = {"meta", "input", "br"};
    if (element.NoChildren() && std::ranges::find(empty_by_nature, element.Name()) == empty_by_nature.end()) {
      PushText("");
    }
    return XMLPrinter::VisitExit(element);
  }
};

}  // namespace

std::string fill_page(const char* page, const json& data) {
  tinyxml2::XMLDocument document;
  parse(document, page);
  fill(*document.RootElement(), data);
  HtmlPrinter out;
  document.Print(&out);
  return out.CStr();
}

}  // namespace brainshift::pipelines
