#include "mesh/io/threemf/xml.hpp"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <memory>

#include "error.hpp"
#include "stop.hpp"

namespace kreisel::core::threemf {
namespace {

constexpr char separator = ' ';  // in no address

struct Walk {
  XmlVisitor& visitor;
  XML_Parser parser;
  std::exception_ptr thrown = {};

  /// Calls of the visitor from a C library, through which nothing may be thrown.
  template <class Call>
  void guarded(Call&& call) {
    if (thrown) return;
    try {
      stop_here();
      visitor.line = std::size_t(XML_GetCurrentLineNumber(parser));
      call();
    } catch (...) {
      thrown = std::current_exception();
      XML_StopParser(parser, XML_FALSE);
    }
  }
};

Walk& walk_of(void* data) { return *static_cast<Walk*>(data); }

void on_start(void* data, const XML_Char* name, const XML_Char** attributes) {
  walk_of(data).guarded([&] { walk_of(data).visitor.start(Element(name, attributes)); });
}
void on_end(void* data, const XML_Char*) {
  walk_of(data).guarded([&] { walk_of(data).visitor.end(); });
}
void on_text(void* data, const XML_Char* text, int length) {
  walk_of(data).guarded([&] { walk_of(data).visitor.text({text, std::size_t(length)}); });
}
void on_prefix(void* data, const XML_Char* prefix, const XML_Char* space) {
  walk_of(data).guarded([&] { walk_of(data).visitor.prefix(prefix ? prefix : "", space ? space : ""); });
}

}  // namespace

Element::Element(std::string_view full_name, const char* const* attributes) : attributes_(attributes) {
  const std::size_t at = full_name.rfind(separator);
  space = at == std::string_view::npos ? std::string_view{} : full_name.substr(0, at);
  name = at == std::string_view::npos ? full_name : full_name.substr(at + 1);
}

std::optional<std::string_view> Element::get(std::string_view attribute, std::string_view in) const {
  for (const char* const* at = attributes_; *at; at += 2) {
    std::string_view full = *at;
    if (!full.ends_with(attribute)) continue;
    full.remove_suffix(attribute.size());
    if (in.empty() ? full.empty() : full.ends_with(separator) && full.substr(0, full.size() - 1) == in)
      return at[1];
  }
  return std::nullopt;
}

void walk_xml(std::string_view text, const std::string& name, XmlVisitor& visitor) {
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(
      XML_ParserCreateNS(nullptr, separator), &XML_ParserFree);
  Walk walk{visitor, parser.get()};
  XML_SetUserData(parser.get(), &walk);
  XML_SetElementHandler(parser.get(), on_start, on_end);
  XML_SetCharacterDataHandler(parser.get(), on_text);
  XML_SetStartNamespaceDeclHandler(parser.get(), on_prefix);
  constexpr std::size_t most = std::numeric_limits<int>::max() / 2;
  XML_Status status = XML_STATUS_OK;
  do {
    const std::string_view block = text.substr(0, most);
    text.remove_prefix(block.size());
    status = XML_Parse(parser.get(), block.data(), int(block.size()), text.empty());
  } while (status == XML_STATUS_OK && !text.empty());
  if (walk.thrown) std::rethrow_exception(walk.thrown);
  if (status != XML_STATUS_OK)
    throw InputError(fmt::format("{}: line {}: {}, expected well-formed XML", name,
                                 std::size_t(XML_GetCurrentLineNumber(parser.get())),
                                 XML_ErrorString(XML_GetErrorCode(parser.get()))));
}

}  // namespace kreisel::core::threemf
