// xml.hpp - an XML text, element by element.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace kreisel::core::threemf {

/// The start of an element; its namespace by address. Valid during the call that gets it.
class Element {
 public:
  Element(std::string_view full_name, const char* const* attributes);

  std::string_view space, name;

  /// The value of an attribute. @param in  its namespace; empty: none
  [[nodiscard]] std::optional<std::string_view> get(std::string_view attribute,
                                                    std::string_view in = {}) const;

 private:
  const char* const* attributes_;
};

/// Who is told. Whatever it throws ends the walk and comes out of it.
class XmlVisitor {
 public:
  virtual ~XmlVisitor() = default;
  virtual void start(const Element& element) = 0;
  virtual void end() {}
  virtual void text(std::string_view) {}
  /// A prefix that the next element declares.
  virtual void prefix(std::string_view, std::string_view /*space*/) {}
  /// Where it has got to, for its errors.
  std::size_t line = 0;
};

/// Walks a whole text, in any encoding that it declares.
/// @param name  what errors call it
/// @throws InputError  not well-formed, with its line
void walk_xml(std::string_view text, const std::string& name, XmlVisitor& visitor);

}  // namespace kreisel::core::threemf
