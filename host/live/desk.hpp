// desk.hpp - where one tab's requests are taken and answered. [docs/live.md]
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "live/answers.hpp"
#include "live/message.hpp"
#include "live/nestings.hpp"
#include "live/setup.hpp"
#include "live/solids.hpp"
#include "live/worker.hpp"

namespace kreisel::core::live {

/// One line for whatever `work` throws, in the words of the command line; empty: nothing was thrown, or it
/// was stopped.
[[nodiscard]] std::string trouble_of(const std::function<void()>& work);

/// Takes requests as they come, and works on them in two threads of its own: one that answers while a hand
/// moves, one for what takes long. Whatever a request is, it is answered: what is wrong with it in one line.
class Desk {
 public:
  Desk(std::shared_ptr<const Setup> setup, Send send);

  /// @param text  JSON: {"do": a request's name, "id": anything, ...}
  void take(std::string_view text);
  /// @param bytes  a line of the same, then what belongs to it
  void take_bytes(std::string bytes);
  /// Asks what is under way to stop. Does not wait.
  void close();

 private:
  struct Request {
    nlohmann::json said;
    std::string bytes;
    [[nodiscard]] nlohmann::json id() const { return said.value("id", nlohmann::json()); }
    /// @throws InputError  it says none
    [[nodiscard]] std::string text(const char* name) const;
    /// False where it does not say. @throws InputError  neither true nor false
    [[nodiscard]] bool yes(const char* name) const;
    [[nodiscard]] nlohmann::json fields(const char* name) const;
  };
  struct Entry {
    std::string_view name;
    void (Desk::*answer)(Request request);
  };
  static const std::vector<Entry>& entries();
  [[nodiscard]] static std::vector<std::string_view> names();

  void answer(Request request);
  void hello(Request request);
  void open(Request request);
  void ask(Request request);
  void make(Request request);
  void help(Request request);
  void map(Request request);
  void move(Request request);
  void into(Request request);
  void nest(Request request);
  void optimise(Request request);
  void stop(Request request);

  /// Has a worker do it; what it throws is sent.
  void put(Worker& worker, std::string kind, const nlohmann::json& id, Worker::Job job);
  void refuse(const nlohmann::json& id, std::string_view text) const;
  void require_memory() const;
  [[nodiscard]] RunConfig question_of(const Request& request) const;
  void show(const nlohmann::json& id, Opened opened);
  /// Of the body that is open, for the working thread. @throws InputError  none is
  Session& workbench(RunConfig& question);
  [[nodiscard]] std::shared_ptr<Nestings> nestings();

  std::shared_ptr<const Setup> setup_;
  Send send_;
  std::unique_ptr<Answers> answers_;  ///< of the answering thread alone
  std::mutex mutex_;
  std::shared_ptr<const Opened> opened_;  ///< these two guarded by it
  std::shared_ptr<Nestings> nestings_;
  std::shared_ptr<const Opened> on_bench_;  ///< these two of the working thread alone
  std::optional<Session> bench_;
  Worker answering_, working_{Worker::Pace::patient};  ///< the last, so that they end first
};

}  // namespace kreisel::core::live
