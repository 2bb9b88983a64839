#include "apps/shared/program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <malloc.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>
#include <vector>

#include "apps/shared/exit_code.hpp"
#include "apps/shared/outputs.hpp"
#include "control.hpp"
#include "error.hpp"
#include "file/replace_file.hpp"
#include "memory.hpp"
#include "nearest.hpp"
#include "run/run.hpp"

namespace kreisel::core::apps {
namespace {

const char* program_name = "";  // a handler of terminate has no argument to get it by

std::stop_source& interruptions() {
  static std::stop_source source;
  return source;
}

/// What is still at work then will not end by itself: a library's loop asks nobody.
extern "C" void on_alarm(int) {
  remove_temporary_files();
  constexpr std::string_view what = ": interrupted, what was under way is not written\n";
  for (const std::string_view text : {std::string_view(program_name), what})
    if (::write(STDERR_FILENO, text.data(), text.size()) < 0) break;
  ::_exit(was_interrupted);
}

/// Nobody registers a callback with this source, so that to ask is no more than an atomic operation.
extern "C" void on_signal(int number) {
  constexpr itimerval patience = {{0, 0}, {0, 700'000}};  // with what it takes to end: within a second
  interruptions().request_stop();
  std::signal(number, SIG_DFL);
  std::signal(SIGALRM, on_alarm);
  (void)::setitimer(ITIMER_REAL, &patience, nullptr);
}

/// Prints the one line of an error. @return  the code
int say(std::string_view what, int code) {
  std::fflush(stdout);
  fmt::print(stderr, "{}: {}\n", program_name, what);
  return code;
}

int say_memory_ran_out() {
  const Memory memory = available_memory();
  return say(
      fmt::format("not enough memory, {} {:.2g} GiB; expected more, a coarser --resolution or a mesh of "
                  "fewer triangles",
                  memory.of, memory.bytes / (1 << 30)),
      not_converged);
}

int run(int (*dispatch)(int, char**), int argc, char** argv) {
  try {
    const int code = dispatch(argc, argv);
    flush_output();
    return code;
  } catch (const InputError& error) {
    return say(error.what(), bad_input);
  } catch (const Interrupted&) {
    return say("interrupted, nothing written", was_interrupted);
  } catch (const MemoryError& error) {
    return say(error.what(), not_converged);
  } catch (const std::bad_alloc&) {
    return say_memory_ran_out();
  } catch (const std::exception& error) {
    // What is printed goes out whenever a buffer is full, and throws then what fmt throws.
    if (std::ferror(stdout)) return say(output_error(), bad_input);
    return say(fmt::format("internal error: {}", error.what()), 1);
  }
}

/// What a library's thread throws reaches no catch of ours.
[[noreturn]] void on_terminate() {
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    std::_Exit(say_memory_ran_out());
  } catch (const std::exception& error) {
    std::_Exit(say(fmt::format("internal error: {}", error.what()), 1));
  } catch (...) {
  }
  std::abort();
}

/// Vectors of a mesh's size come and go. Pages that the system takes back each time must be cleared and
/// mapped each time.
void keep_pages() {
  constexpr int mebibyte = 1 << 20;
  ::mallopt(M_MMAP_THRESHOLD, 32 * mebibyte);  // the largest that is taken; what is larger goes back at once
  ::mallopt(M_TRIM_THRESHOLD, 256 * mebibyte);
  ::mallopt(M_TOP_PAD, 16 * mebibyte);
}

/// Kinds of runs that have this option, though this command has not.
std::vector<std::string_view> kinds_with(std::string_view option) {
  std::vector<std::string_view> kinds;
  for (const RunKind& kind : run_kinds())
    if (std::ranges::any_of(kind.fields,
                            [&](const Field<Run>& field) { return option == "--" + option_of(field); }))
      kinds.push_back(kind.name);
  return kinds;
}

}  // namespace

std::stop_token interruption() { return interruptions().get_token(); }

std::string explained(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* used = app.get_subcommands().empty() ? &app : app.get_subcommands().front();
  const std::string name = used == &app ? app.get_name() : app.get_name() + " " + used->get_name();
  const std::string help = fmt::format("({} --help lists the options)", name);
  std::vector<std::string> extras;
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) extras = used->remaining(true);
  if (extras.empty()) return fmt::format("{} {}", error.what(), help);
  std::vector<std::string> commands;
  for (const CLI::App* sub : used->get_subcommands(nullptr)) commands.push_back(sub->get_name());
  // A misspelt command makes everything else unknown; so does an unknown option of what follows it.
  const auto command = std::ranges::find_if(
      extras, [&](const std::string& e) { return !e.starts_with('-') && !nearest(e, commands).empty(); });
  const auto option = std::ranges::find_if(extras, [](const std::string& e) { return e.starts_with('-'); });
  const std::string& extra = command != extras.end()  ? *command
                             : option != extras.end() ? *option
                                                      : extras.front();
  if (const auto kinds = kinds_with(extra.substr(0, extra.find('='))); !kinds.empty())
    return fmt::format("'{}' was not expected; expected a kind of run that has it: {} {}", extra,
                       fmt::join(kinds, ", "), help);
  std::vector<std::string> names = commands;
  for (const CLI::Option* known : used->get_options()) names.push_back(known->get_name());
  const std::string meant = nearest(extra.substr(0, extra.find('=')), names);
  return fmt::format("'{}' was not expected{}; expected an option or a command {}", extra,
                     meant.empty() ? "" : fmt::format(" (did you mean '{}'?)", meant), help);
}

void run_program(const char* name, int (*dispatch)(int, char**), int argc, char** argv) {
  program_name = name;
  keep_pages();
  (void)interruptions();  // made ahead of any signal
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::set_terminate(on_terminate);
  // A file that may not grow fails as on a full disk: the write says so and what is begun is removed.
  std::signal(SIGXFSZ, SIG_IGN);
  const int code = run(dispatch, argc, argv);
  std::fflush(stdout);
  // Without the goodbyes of libraries: OpenBLAS' waits for its threads, which, where memory is short, wait
  // for memory.
  std::_Exit(code);
}

}  // namespace kreisel::core::apps
