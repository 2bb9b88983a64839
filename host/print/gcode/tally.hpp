// tally.hpp - beads, summed by what they belong to.
#pragma once

#include <compare>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "print/gcode/beads.hpp"
#include "print/gcode/print.hpp"

namespace kreisel::core {

/// Whose filament, and whether its lengths are volumes: all that the moments of beads still wait for.
struct FilamentSource {
  int tool = 0;
  bool volumetric = false;
  auto operator<=>(const FilamentSource&) const = default;
};

/// Sums beads. Whoever lays them says first when something about them changes.
class Tally {
 public:
  /// Of the beads that follow. Those of the file so far were laid before there was a type: they are no part,
  /// when one is said at all. @throws InputError  too many different ones, as below
  void set_type(std::string_view type);
  void set_object(std::string_view label);
  void set_source(const FilamentSource& source);
  /// Purged or of a raft: no part, whatever its type.
  void set_beside(bool is);
  void begin_layer();

  /// Where the next bead goes. @param from, to  of the nozzle's path
  Beads& along(const Vec3& from, const Vec3& to) {
    if (begins_layer_ && !(run_.filament() > 0)) layer_z_ = to[2];
    reach_.add(from);
    reach_.add(to);
    return run_;
  }

  /// Adds groups and layers to a print whose filaments are known. @param all_volumetric  E was in mm^3
  /// throughout
  void add_to(Print& print, bool all_volumetric);

 private:
  /// Names by their numbers; the empty one is 0.
  class Names {
   public:
    int of(std::string_view name, const char* what);
    [[nodiscard]] const std::string& name(int number) const { return names_[std::size_t(number)]; }

   private:
    std::vector<std::string> names_ = {""};
    std::map<std::string, int, std::less<>> numbers_ = {{"", 0}};
  };
  struct Key {
    int type = 0, object = 0;
    bool beside = false;
    FilamentSource source;
    auto operator<=>(const Key&) const = default;
  };
  struct Group {
    std::size_t began;  ///< after so many others
    Beads sum;
  };
  struct Layer {
    double z = 0;
    std::map<FilamentSource, Beads> sums = {};
  };

  /// The lowest layer of an object.
  struct Foot {
    std::size_t began;  ///< after so many others
    double z;
    Beads sum = {};
  };

  [[nodiscard]] bool of_part(const Key& key) const;
  void flush();
  void stand_on(double z);

  Names types_, objects_;
  Key key_;
  Beads run_;  ///< since something changed
  Box reach_;  ///< of its path
  Box part_;   ///< of all paths of the part
  std::map<Key, Group> groups_;
  std::vector<Layer> layers_;
  std::map<int, Foot> feet_;  ///< of the objects
  bool typed_ = false, begins_layer_ = true;
  double layer_z_ = 0;
};

}  // namespace kreisel::core
