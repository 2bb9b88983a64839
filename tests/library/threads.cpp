// threads.cpp - 200 solves in eight threads, a session each, give the same bits as in sequence. Built with
// the thread sanitizer by tests/long.sh, against the library alone, so that little else runs.
#include <atomic>
#include <cstring>
#include <iostream>
#include <kreisel/kreisel.hpp>
#include <thread>
#include <vector>

namespace {

using namespace kreisel;

constexpr int threads = 8, each = 25;

/// Mixed: what a solve shares with others is the body, the device, and of Ipopt's the library's lock.
Question question(int i) {
  Question q;
  q.domain.cells = {40, 0, 0};
  q.domain.wall_mm = i % 3 == 0 ? 2.0 : 1.5;
  if (i % 5 == 1) q.problem = {"float", {{"draft", i % 2 ? "60%" : "70%"}}};
  if (i % 5 == 2) q.pose.axis = Vec3(0.1 * (i % 4), 0, 1);
  if (i % 5 == 3) q.formulation = {"rayrep"};
  return q;
}

std::vector<Solution> answers(const Body& body, const Device& device, int first) {
  Session session(body, device);
  std::vector<Solution> all;
  for (int i = 0; i < each; ++i) all.push_back(session.solve(question(first + i)));
  return all;
}

bool same(const Solution& a, const Solution& b) {
  return a.end == b.end && a.variables.size() == b.variables.size() &&
         std::memcmp(a.variables.data(), b.variables.data(), a.variables.size() * sizeof(double)) == 0 &&
         a.moments == b.moments;
}

}  // namespace

int main() {
  const Body body = Body::model("ellipsoid");
  const Device device;
  std::vector<std::vector<Solution>> in_sequence, at_once(threads);
  for (int t = 0; t < threads; ++t) in_sequence.push_back(answers(body, device, t * each));
  std::vector<std::thread> running;
  for (int t = 0; t < threads; ++t)
    running.emplace_back([&, t] { at_once[static_cast<std::size_t>(t)] = answers(body, device, t * each); });
  for (std::thread& thread : running) thread.join();
  int differ = 0;
  for (std::size_t t = 0; t < in_sequence.size(); ++t)
    for (std::size_t i = 0; i < in_sequence[t].size(); ++i) differ += !same(in_sequence[t][i], at_once[t][i]);
  std::cout << threads * each << " solves, " << differ << " differ\n";
  return differ == 0 ? 0 : 1;
}
