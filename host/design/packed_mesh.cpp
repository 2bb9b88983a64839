#include "design/packed_mesh.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace kreisel::core {
namespace {

using Place = std::array<std::uint16_t, 3>;

constexpr std::uint32_t unnumbered = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t near = 100;         // that a byte tells a distance up to
constexpr std::uint8_t far = 255;           // a number follows
constexpr std::size_t longest_chain = 255;  // that a byte counts
constexpr double steps = 16383;             // of the longest edge: 14 bits

/// Where the next corner of a chain is taken to lie, from v and the two before it: the fourth of a
/// parallelogram.
class Guess {
 public:
  explicit Guess(const Place& v) : v_(v), next_(v) {}

  [[nodiscard]] const Place& next() const { return next_; }
  void passed(const Place& corner) {
    next_ = corner;
    if (last_)
      for (std::size_t k = 0; k < 3; ++k)
        next_[k] = static_cast<std::uint16_t>(v_[k] + corner[k] - (*last_)[k]);
    last_ = corner;
  }

 private:
  Place v_, next_;
  std::optional<Place> last_;
};

/// A difference modulo 2^16 with its sign in the lowest bit.
std::uint16_t folded(std::uint16_t difference) {
  const auto d = static_cast<std::int16_t>(difference);
  return static_cast<std::uint16_t>(d < 0 ? -2 * d - 1 : 2 * d);
}

std::uint16_t unfolded(std::uint16_t code) {
  return static_cast<std::uint16_t>(code & 1 ? -((code + 1) / 2) : code / 2);
}

/// Which triangles have a corner: those of v are all[first[v]] to all[first[v + 1]].
struct Around {
  std::vector<std::uint32_t> first, all;

  explicit Around(const TriangleMesh& mesh)
      : first(mesh.vertices.size() + 1), all(3 * mesh.triangles.size()) {
    for (const Triangle& t : mesh.triangles)
      for (const std::uint32_t v : t) ++first[v + 1];
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (const std::uint32_t v : mesh.triangles[t]) all[next[v]++] = t;
  }
};

class Packer {
 public:
  explicit Packer(const TriangleMesh& mesh)
      : mesh_(mesh), around_(mesh), number_(mesh.vertices.size(), unnumbered), done_(mesh.triangles.size()) {
    const Box box = bounding_box(mesh);
    out_.low = box.lo;
    out_.step = box.extent().maxCoeff() / steps;
    for (std::size_t t = 0; t < done_.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      done_[t] = a == b || b == c || c == a;
    }
  }

  PackedMesh run() {
    for (std::uint32_t seed = 0; seed < number_.size(); ++seed) {
      if (number_[seed] != unnumbered || fan_of(seed).empty()) continue;
      add(seed, {});
      while (head_ < order_.size()) write_fan(order_[head_++]);
    }
    out_.corners = order_.size();
    for (const int shift : {0, 8})
      for (const std::uint16_t code : codes_) out_.places.push_back(static_cast<std::uint8_t>(code >> shift));
    return std::move(out_);
  }

 private:
  struct Edge {  // of a triangle (v, a, b)
    std::uint32_t a, b, triangle;
  };

  [[nodiscard]] std::vector<Edge> fan_of(std::uint32_t v) const {
    std::vector<Edge> fan;
    for (std::uint32_t i = around_.first[v]; i < around_.first[v + 1]; ++i) {
      const std::uint32_t t = around_.all[i];
      if (done_[t]) continue;
      const Triangle& c = mesh_.triangles[t];
      const std::size_t k = c[0] == v ? 0 : c[1] == v ? 1 : 2;
      fan.push_back({c[(k + 1) % 3], c[(k + 2) % 3], t});
    }
    return fan;
  }

  void write_fan(std::uint32_t v) {
    std::vector<Edge> fan = fan_of(v);
    while (!fan.empty()) {
      // Where none comes before it, if there is such a place; a fan all around begins anywhere.
      const auto begins = [&](const Edge& e) { return std::ranges::find(fan, e.a, &Edge::b) == fan.end(); };
      auto at = std::ranges::find_if(fan, begins);
      if (at == fan.end())
        at = std::ranges::find_if(fan, [&](const Edge& e) { return number_[e.a] != unnumbered; });
      if (at == fan.end()) at = fan.begin();
      std::vector<std::uint32_t> chain = {at->a};
      while (at != fan.end() && chain.size() <= longest_chain) {
        chain.push_back(at->b);
        done_[at->triangle] = true;
        fan.erase(at);
        at = std::ranges::find(fan, chain.back(), &Edge::a);
      }
      write_chain(v, chain);
    }
    out_.links.push_back(0);
  }

  void write_chain(std::uint32_t v, const std::vector<std::uint32_t>& chain) {
    out_.triangles += chain.size() - 1;
    out_.links.push_back(static_cast<std::uint8_t>(chain.size() - 1));
    Guess guess(places_[number_[v]]);
    for (const std::uint32_t corner : chain) {
      if (number_[corner] == unnumbered) {
        out_.links.push_back(0);
        add(corner, guess.next());
      } else {
        write_known(number_[corner], number_[v]);
      }
      guess.passed(places_[number_[corner]]);
    }
  }

  void write_known(std::uint32_t corner, std::uint32_t v) {
    const auto below = static_cast<std::uint32_t>(order_.size()) - corner;
    std::uint32_t above = corner - v;  // all triangles of those before v are done
    if (below <= near) return out_.links.push_back(static_cast<std::uint8_t>(below));
    if (above <= near) return out_.links.push_back(static_cast<std::uint8_t>(near + above));
    out_.links.push_back(far);
    for (; above >= 128; above /= 128) out_.links.push_back(static_cast<std::uint8_t>(above % 128 + 128));
    out_.links.push_back(static_cast<std::uint8_t>(above));
  }

  void add(std::uint32_t vertex, const Place& guess) {
    number_[vertex] = static_cast<std::uint32_t>(order_.size());
    order_.push_back(vertex);
    Place place{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      const double at = out_.step > 0 ? (mesh_.vertices[vertex][axis] - out_.low[axis]) / out_.step : 0;
      place[k] = static_cast<std::uint16_t>(std::lround(at));
      codes_.push_back(folded(static_cast<std::uint16_t>(place[k] - guess[k])));
    }
    places_.push_back(place);
  }

  const TriangleMesh& mesh_;
  Around around_;
  std::vector<std::uint32_t> number_;  ///< of vertices
  std::vector<bool> done_;             ///< triangles
  std::vector<std::uint32_t> order_;   ///< vertices by their numbers
  std::vector<Place> places_;          ///< of them
  std::vector<std::uint16_t> codes_;
  std::size_t head_ = 0;
  PackedMesh out_;
};

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto byte = [&](std::size_t i) { return i < bytes.size() ? std::uint32_t{bytes[i]} : 0U; };
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::uint32_t three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63u];
  }
  return text;
}

}  // namespace

PackedMesh packed(const TriangleMesh& mesh) {
  return mesh.triangles.empty() ? PackedMesh{} : Packer(mesh).run();
}

TriangleMesh unpacked(const PackedMesh& mesh) {
  TriangleMesh out;
  std::vector<Place> places;
  std::size_t at = 0;
  const auto add = [&](const Place& guess) {
    Place place{};
    Vec3 p;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = 3 * places.size() + k;
      const auto code = static_cast<std::uint16_t>(mesh.places[i] | mesh.places[3 * mesh.corners + i] << 8);
      place[k] = static_cast<std::uint16_t>(guess[k] + unfolded(code));
      p[static_cast<Eigen::Index>(k)] = mesh.low[static_cast<Eigen::Index>(k)] + mesh.step * place[k];
    }
    places.push_back(place);
    out.vertices.push_back(p);
    return static_cast<std::uint32_t>(places.size() - 1);
  };
  const auto corner = [&](std::uint32_t v, const Place& guess) {
    const std::uint32_t code = mesh.links[at++];
    if (code == 0) return add(guess);
    if (code <= near) return static_cast<std::uint32_t>(places.size()) - code;
    if (code != far) return v + code - near;
    std::uint32_t above = 0;
    for (int shift = 0;; shift += 7) {
      const std::uint32_t part = mesh.links[at++];
      above |= (part & 127U) << shift;
      if (part < 128) return v + above;
    }
  };
  for (std::uint32_t v = 0; v < mesh.corners; ++v) {
    if (v == places.size()) (void)add({});
    while (const std::size_t count = mesh.links[at++]) {
      Guess guess(places[v]);
      std::uint32_t last = corner(v, guess.next());
      guess.passed(places[last]);
      for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t next = corner(v, guess.next());
        guess.passed(places[next]);
        out.triangles.push_back({v, last, next});
        last = next;
      }
    }
  }
  return out;
}

std::string compressed_text(const void* bytes, std::size_t size) {
  z_stream stream{};
  constexpr int gzip = 16 + 15, memory = 9;
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, gzip, memory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("no memory to compress a page");
  std::vector<std::uint8_t> out(deflateBound(&stream, size));
  stream.next_in = static_cast<Bytef*>(const_cast<void*>(bytes));  // zlib reads it only
  stream.avail_in = static_cast<uInt>(size);
  stream.next_out = out.data();
  stream.avail_out = static_cast<uInt>(out.size());
  const int ended = deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  if (ended != Z_STREAM_END) throw std::runtime_error("a page could not be compressed");
  return base64(out);
}

}  // namespace kreisel::core
