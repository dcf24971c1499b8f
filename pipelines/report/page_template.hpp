// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace brainshift::pipelines {

/// Fills a page, which is well-formed XML, with data:
/// - {{name}} in text and in attributes becomes the value of that name: a string, escaped as XML wants it.
/// - An element with the attribute each="name" stands once for each item of a list, and once for an object: the names
/// in
///   it are then the item's. For true it stands once with the names around it; for false, and where there is no such
///   name, not at all.
/// - <picture svg="name"/> gives way to the element that the value of that name is the text of.
/// Comments are left out. tinyxml2 parses, escapes and writes. Throws std::logic_error when the page or a picture is
/// not well-formed, or names what the data do not have.
std::string fill_page(const char* page, const nlohmann::json& data);

}  // namespace brainshift::pipelines
