#include "record/common_groups.hpp"

namespace kreisel::core {

void write_vector(hdf5::Group& group, const std::string& name, const Vec3& v, const char* units) {
  group.write(name, {v.data(), 3}, {3}, {units, {"x", "y", "z"}});
}

void write_config(hdf5::Group group, const std::map<std::string, std::string>& fields) {
  for (const auto& [key, value] : fields) group.set(key, value);
}

void write_provenance(hdf5::Group group, const Provenance& p) {
  group.set("version", p.version);
  group.set("commit", p.commit);
  group.set("compiler", p.compiler);
  group.set("build_type", p.build_type);
  group.set("host", p.host);
  group.set("processor", p.processor);
  group.set("system", p.system);
  group.set("threads", p.threads);
  group.set("device", p.device);
  group.set("platform", p.platform);
  group.set("driver", p.driver);
  group.set("device_version", p.device_version);
  group.set("device_fp64", p.device_fp64);
  group.set("single_precision", p.single_precision);
  group.set("ipopt_version", p.ipopt_version);
  group.set("linear_solver", p.linear_solver);
  group.set("blas", p.blas);
  group.set("started", p.started);
  group.set("load", p.load);
}

}  // namespace kreisel::core
