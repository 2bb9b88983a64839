// session.hpp - a body and its domain that live, so that the next question costs no more than what it
// changes.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "body/source.hpp"
#include "control.hpp"
#include "session/config.hpp"
#include "session/kept.hpp"
#include "session/provenance.hpp"
#include "session/run_domain.hpp"
#include "solve/solver.hpp"

namespace kreisel::core {

/// What an answer stands on. Moments are in the frame of `body`, in which the rays lie.
struct Stages {
  std::shared_ptr<device::Device> device;
  std::shared_ptr<const Body> body;
  std::shared_ptr<const Body> pose;  ///< as the question lays it: another frame where the rays were kept
  std::shared_ptr<const RunDomain> domain;
  std::shared_ptr<Formulation> formulation;  ///< of the domain; refers to it and to the device
  std::shared_ptr<const Problem> problem;
  MassModel mass;
  double opening_seconds = 0;  ///< of the device, where it had to be opened

  [[nodiscard]] Task task(std::stop_token stop) const { return task_with(mass, std::move(stop)); }
  /// The same with other masses. @param mass  outlives the task
  [[nodiscard]] Task task_with(const MassModel& other, std::stop_token stop) const {
    return {*problem, *formulation, other, *device, std::move(stop)};
  }
};

/// May the rays of another axis be kept, and the problem be turned? Not where a part is to be made: its mesh
/// is cut along the rays.
enum class Along { any_axis, own_axis };

/// Keeps each stage by what it depends on, and makes again what a question changes:
///
///     mesh file -> mesh -> body -> pose -> domain -> formulation
///                                    \-> problem (turned, where the rays keep another axis)
///
/// Weights, targets and drafts make a problem; densities a pose; an axis, contact point or base a pose and a
/// problem, the rays stay (of the quadric on exact rays with a wall in mm); a wall or grid the domain and
/// what stands on it (of exact rays another wall keeps where they cross the surface); a size, unit or axle
/// everything but the file.
///
/// One thread at a time. Two sessions in two threads are independent: each has its own queue and kernels.
class Session {
 public:
  /// Bodies as the questions name them, each device opened as they ask.
  Session();
  /// Of one body, on one device; what questions say of mesh, fineness, unit and device is left aside.
  /// @param solid  a solid's mesh, with what is known of it (load_solid)
  Session(std::shared_ptr<const Source> solid, std::shared_ptr<device::Device> device);

  /// The solid that the question is of: its mesh alone, with nothing else of the question judged. No device
  /// is opened.
  /// @throws InputError  no such mesh, or no solid
  [[nodiscard]] std::shared_ptr<const Source> solid(const Asked& question);

  /// Everything that the question stands on.
  /// @throws InputError   bad configuration or mesh
  /// @throws Interrupted  between two stages; those made are kept
  [[nodiscard]] Stages stages(const Asked& question, const Control& control = {},
                              Along rays = Along::own_axis);

  /// The body of a question as its DeformSpec deforms it, in a session of its own.
  struct OfDeformed;
  /// Kept as long as nothing that it depends on changes. @param stages  of the question as it stands
  /// @throws InputError, Interrupted
  [[nodiscard]] std::shared_ptr<OfDeformed> deformed(const RunConfig& question, const Stages& stages,
                                                     const Control& control = {});

  /// The stages that the last question made anew, in their order: device, mesh, body, pose, domain,
  /// problem, formulation.
  [[nodiscard]] const std::vector<std::string_view>& made() const { return made_; }
  /// Of the device in use. @pre  stages() was called
  [[nodiscard]] const Provenance& provenance();

  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

 private:
  struct Laid {
    std::shared_ptr<const RunDomain> domain;
    std::shared_ptr<const Body> body;  ///< in whose frame it lies
  };
  struct DeviceKey {
    std::string selector;
    bool single = false;
    bool operator==(const DeviceKey&) const = default;
  };
  struct SourceKey {
    std::string model;
    int fineness = 0;
    std::optional<LengthUnit> unit;
    Mending mending;
    bool operator==(const SourceKey&) const = default;
  };
  struct BodyKey {
    std::shared_ptr<const Source> source;
    std::shared_ptr<device::Device> device;
    std::optional<double> size;
    std::optional<BodySpec> shaped;  ///< it is cut across its axis, or has a stem along it
    bool operator==(const BodyKey&) const = default;
  };
  struct PoseKey {
    std::shared_ptr<const Body> body;
    BodySpec spec;
    SettingTexts laid_by;  ///< of a problem that says how its rays are laid; else empty
    bool operator==(const PoseKey&) const = default;
  };
  struct DomainKey {
    std::shared_ptr<const Body> body;
    Vec3 axis, contact;  ///< along which the rays run, and where they have their origin
    std::string kind;
    GridSpec grid;
    Wall wall;
    bool operator==(const DomainKey&) const = default;
  };
  struct LinesKey {
    std::shared_ptr<const Body> body;
    Vec3 axis, contact;
    GridSpec grid;
    bool operator==(const LinesKey&) const = default;
  };
  struct FormulationKey {
    std::shared_ptr<const RunDomain> domain;
    std::string name;
    SettingTexts settings;
    Filling filling = {};
    bool operator==(const FormulationKey&) const = default;
  };
  struct ProblemKey {
    std::shared_ptr<const Body> pose, rays;
    std::string name;
    SettingTexts settings;
    bool operator==(const ProblemKey&) const = default;
  };

  struct DeformKey {
    std::shared_ptr<const Body> pose;
    std::shared_ptr<const RunDomain> domain;
    std::string problem;
    SettingTexts settings;
    DeformSpec spec;
    int cells = 0;
    bool operator==(const DeformKey&) const = default;
  };

  template <class Key, class Value, class Make>
  std::shared_ptr<Value> stage(std::string_view name, Kept<Key, Value>& kept, Key key, const Make& make);
  void lay_out(Stages& stages, const Asked& question, const ProblemEntry& asked, const Control& control,
               Along rays);
  std::shared_ptr<device::Device> device_of(const Asked& question);
  std::shared_ptr<const Body> body_of(const Asked& question, const BodySpec& spec,
                                      const std::shared_ptr<device::Device>& device);
  std::shared_ptr<const Body> pose_of(const Asked& question, const BodySpec& spec,
                                      const std::shared_ptr<const Body>& body);
  std::shared_ptr<const Laid> domain_of(const Asked& question, const std::shared_ptr<const Body>& pose,
                                        Along rays);
  RunDomain domain_within(const Asked& question, const Body& pose);
  std::shared_ptr<Formulation> formulation_of(const Asked& question, const Laid& laid, const Problem& problem,
                                              const std::shared_ptr<device::Device>& device);
  std::shared_ptr<const Problem> problem_of(const Asked& question, const std::shared_ptr<const Body>& pose,
                                            const std::shared_ptr<const Body>& rays);

  std::shared_ptr<const Source> given_;
  std::shared_ptr<device::Device> given_device_;
  Kept<DeviceKey, device::Device> device_;
  Kept<SourceKey, const Source> source_;
  Kept<BodyKey, const Body> body_;
  BodySpec made_as_;  ///< the specification that body_ was made by
  Kept<PoseKey, const Body> pose_;
  Kept<LinesKey, const SolidLines> lines_;  ///< of an exact domain: what another wall leaves as it is
  Kept<DomainKey, const Laid> domain_;
  Kept<FormulationKey, Formulation> formulation_;
  Kept<ProblemKey, const Problem> problem_;
  Kept<DeformKey, OfDeformed> deformed_;
  std::optional<Provenance> provenance_;
  std::vector<std::string_view> made_;
};

}  // namespace kreisel::core
