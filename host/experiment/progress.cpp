#include "experiment/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "table/experiment_run.hpp"

namespace kreisel::core {
namespace {

/// Work of a run relative to others of its formulation: cells^1.2. An iteration costs about as much as there
/// are cells; the fifth root more stands for the growing number of iterations and the fill of the factors.
/// The count of the whole box will do, since the share of it that is interior hardly changes between grids of
/// one body.
double weight(const Asked& config) {
  const double n = config.grid.resolution;
  double cells = n * n * n;
  if (config.grid.cells) {
    const auto& c = *config.grid.cells;
    cells = static_cast<double>(c[0]) * c[1] * c[2];
  }
  return std::pow(cells, 1.2);
}

/// Of a nesting: placements asked for.
double weight(const NestConfig& config) {
  if (const auto* accuracy = part_of<NestAccuracy>(config)) return accuracy->accuracy;
  const auto* search = part_of<NestSearch>(config);
  if (!search) return 1;
  const nest::SwarmOptions& swarm = search->search.swarm;
  return static_cast<double>(swarm.particles) * (swarm.iterations + 1);
}

std::size_t columns(std::FILE* out) {
  winsize size{};
  return ioctl(fileno(out), TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col : 80;
}

}  // namespace

Effort effort_of(const ExperimentRun& run) {
  if (const auto* nest = std::get_if<NestConfig>(&*run.run))
    return {run_text(run), fmt::format("{} {}", shapes_text(*nest), kind_of(*nest)), weight(*nest)};
  // Formulations differ by an order of magnitude.
  return {run_text(run), run.asked().formulation, weight(run.asked())};
}

void Estimate::finished(const Effort& run, double seconds) {
  for (Spent* spent : {&by_kind_[run.kind], &all_}) {
    spent->seconds += seconds;
    spent->weight += run.weight;
  }
}

std::optional<double> Estimate::seconds(const Effort& run) const {
  const auto own = by_kind_.find(run.kind);
  const Spent& spent = own != by_kind_.end() ? own->second : all_;
  if (spent.weight <= 0) return std::nullopt;
  return spent.seconds / spent.weight * run.weight;
}

std::string duration_text(double seconds) {
  const auto s = static_cast<long long>(std::llround(std::max(seconds, 0.0)));
  if (s < 100) return fmt::format("{} s", s);
  const long long minutes = (s + 30) / 60;
  if (minutes < 100) return fmt::format("{} min", minutes);
  return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
}

ProgressLine::ProgressLine(std::FILE* out, std::vector<Effort> runs)
    : out_(out), terminal_(isatty(fileno(out)) != 0), runs_(std::move(runs)) {
  if (terminal_) ticker_ = std::jthread([this](const std::stop_token& stop) { tick(stop); });
}

ProgressLine::~ProgressLine() {
  const std::lock_guard lock(mutex_);
  if (terminal_ && running_) erase();
  running_ = false;
}

void ProgressLine::tick(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    if (running_) draw();
    wake_.wait_for(lock, stop, std::chrono::seconds(1), [] { return false; });
  }
}

void ProgressLine::begin(std::size_t index) {
  const std::lock_guard lock(mutex_);
  index_ = index;
  running_ = true;
  began_ = Clock::now();
  step_.clear();
  if (terminal_) draw();
}

void ProgressLine::step(const std::string& text) {
  const std::lock_guard lock(mutex_);
  step_ = text;
  if (terminal_ && running_) draw();
}

double ProgressLine::end(bool counts) {
  const std::lock_guard lock(mutex_);
  const double seconds = elapsed();
  if (counts) estimate_.finished(runs_.at(index_), seconds);
  running_ = false;
  if (terminal_) erase();
  return seconds;
}

void ProgressLine::note(const std::string& line) {
  if (!terminal_) return;
  const std::lock_guard lock(mutex_);
  erase();
  fmt::print(out_, "[{}/{}] {}\n", index_ + 1, runs_.size(), line);
  std::fflush(out_);
}

void ProgressLine::tell(const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (terminal_ && running_) erase();
  fmt::print(out_, "{}\n", line);
  std::fflush(out_);
  if (terminal_ && running_) draw();
}

double ProgressLine::elapsed() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

std::string ProgressLine::left() const {
  double total = 0;
  for (std::size_t i = index_; i < runs_.size(); ++i) {
    const auto seconds = estimate_.seconds(runs_[i]);
    if (!seconds) return {};
    total += i == index_ ? std::max(*seconds - elapsed(), 0.0) : *seconds;
  }
  return fmt::format(", about {} left", duration_text(total));
}

void ProgressLine::draw() {
  std::string line = fmt::format("[{}/{}] {}", index_ + 1, runs_.size(), runs_.at(index_).text);
  if (!step_.empty()) line += ": " + step_;
  const std::string tail = fmt::format(" ... {}{}", duration_text(elapsed()), left());
  // A line that wraps cannot be taken back with \r; the times are worth more than the step.
  const std::size_t room = columns(out_) - 1;
  if (line.size() + tail.size() > room) line.resize(room > tail.size() ? room - tail.size() : 0);
  fmt::print(out_, "\r\033[K{}{}", line, tail);
  std::fflush(out_);
}

void ProgressLine::erase() {
  fmt::print(out_, "\r\033[K");
  std::fflush(out_);
}

}  // namespace kreisel::core
