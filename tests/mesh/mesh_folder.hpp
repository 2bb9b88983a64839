// mesh_folder.hpp - a folder of mesh files for each test, gone afterwards.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "mesh/io/read.hpp"
#include "refusal.hpp"

namespace kreisel::core {

class MeshFolder : public ::testing::Test {
 protected:
  MeshFolder() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        std::filesystem::temp_directory_path() /
        ("kreisel_mesh_" + std::string(info->test_suite_name()) + info->name() + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~MeshFolder() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path file(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

  TriangleMesh read(const std::string& name, const std::string& bytes) const {
    return read_mesh(file(name, bytes));
  }

  /// The message is one line with the file, what was expected and all the given parts.
  void refuses(const std::filesystem::path& path, const std::vector<std::string>& parts) const {
    expect_refusal([&] { (void)read_mesh(path); }, path.string(), parts);
  }

  std::filesystem::path folder_;
};

}  // namespace kreisel::core
