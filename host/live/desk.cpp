#include "live/desk.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <new>
#include <utility>

#include "error.hpp"
#include "memory.hpp"
#include "unknown_name.hpp"

namespace kreisel::core::live {
namespace {

/// What this process has in use now, bytes.
double memory_in_use() {
  double all_pages = 0, used_pages = 0;  // the first two numbers of the file
  std::ifstream("/proc/self/statm") >> all_pages >> used_pages;
  return static_cast<double>(::sysconf(_SC_PAGESIZE)) * used_pages;
}

}  // namespace

std::string trouble_of(const std::function<void()>& work) {
  try {
    work();
    return "";
  } catch (const Interrupted&) {
    return "";
  } catch (const std::bad_alloc&) {
    return "not enough memory; expected fewer cells or a mesh of fewer triangles";
  } catch (const std::exception& error) {
    return error.what();
  }
}

std::string Desk::Request::text(const char* name) const {
  const auto found = said.find(name);
  if (found == said.end() || !found->is_string())
    throw InputError(fmt::format("a request without \"{}\"; expected a text", name));
  return found->get<std::string>();
}

bool Desk::Request::yes(const char* name) const {
  const auto found = said.find(name);
  if (found == said.end()) return false;
  if (!found->is_boolean())
    throw InputError(fmt::format("\"{}\": {}; expected true or false", name, text_of(*found)));
  return found->get<bool>();
}

nlohmann::json Desk::Request::fields(const char* name) const {
  return said.value(name, nlohmann::json::object());
}

Desk::Desk(std::shared_ptr<const Setup> setup, Send send)
    : setup_(std::move(setup)), send_(std::move(send)) {}

const std::vector<Desk::Entry>& Desk::entries() {
  static const std::vector<Entry> all = {
      {"hello", &Desk::hello}, {"open", &Desk::open},         {"ask", &Desk::ask},   {"make", &Desk::make},
      {"help", &Desk::help},   {"map", &Desk::map},           {"move", &Desk::move}, {"into", &Desk::into},
      {"nest", &Desk::nest},   {"optimise", &Desk::optimise}, {"stop", &Desk::stop}};
  return all;
}

std::vector<std::string_view> Desk::names() {
  std::vector<std::string_view> all;
  for (const Entry& entry : entries()) all.push_back(entry.name);
  return all;
}

void Desk::take(std::string_view text) {
  Request request;
  request.said = nlohmann::json::parse(text, nullptr, false);
  answer(std::move(request));
}

void Desk::take_bytes(std::string bytes) {
  Request request;
  const std::size_t line = std::min(bytes.find('\n'), setup_->limits.request_bytes);
  if (line < bytes.size()) {
    request.said = nlohmann::json::parse(bytes.substr(0, line), nullptr, false);
    bytes.erase(0, line + 1);
    request.bytes = std::move(bytes);
  }
  answer(std::move(request));
}

void Desk::answer(Request request) {
  if (!request.said.is_object()) return refuse({}, R"(no request; expected JSON: {"do": "hello"})");
  const nlohmann::json id = request.id();
  const std::string trouble = trouble_of([&] {
    const std::string name = request.text("do");
    const auto entry = std::ranges::find(entries(), name, &Entry::name);
    if (entry == entries().end()) throw unknown_name("request", name, names());
    (this->*entry->answer)(std::move(request));
  });
  if (!trouble.empty()) refuse(id, trouble);
}

void Desk::refuse(const nlohmann::json& id, std::string_view text) const {
  send_(message({{"do", "error"}, {"id", id}, {"text", text}}));
}

void Desk::put(Worker& worker, std::string kind, const nlohmann::json& id, Worker::Job job) {
  worker.put(std::move(kind), [this, id, job = std::move(job)](const Worker::Turn& turn) {
    const std::string trouble = trouble_of([&] {
      require_memory();
      job(turn);
    });
    if (!trouble.empty()) refuse(id, trouble);
  });
}

void Desk::require_memory() const {
  const double most =
      setup_->limits.memory_bytes > 0 ? setup_->limits.memory_bytes : available_memory().bytes / 2;
  if (const double used = memory_in_use(); used > most)
    throw InputError(
        fmt::format("{:.2g} GB of memory are in use; expected less than {:.2g}: close other tabs",
                    1e-9 * used, 1e-9 * most));
}

void Desk::close() {
  answering_.stop();
  working_.stop();
}

}  // namespace kreisel::core::live
