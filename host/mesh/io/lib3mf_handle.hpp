// lib3mf_handle.hpp - an object of lib3mf, released in the end; its errors as InputError.
#pragma once

#include <Model/COM/NMR_DLLInterfaces.h>
#include <fmt/format.h>

#include <string>
#include <utility>

#include "error.hpp"

namespace kreisel::core {

class Lib3mfHandle {
 public:
  Lib3mfHandle() = default;
  ~Lib3mfHandle() {
    if (object_) (void)NMR::lib3mf_release(object_);
  }
  Lib3mfHandle(const Lib3mfHandle&) = delete;
  Lib3mfHandle& operator=(const Lib3mfHandle&) = delete;

  /// Where a function of the library puts the object.
  NMR::PLib3MFBase** out() { return &object_; }
  NMR::PLib3MFBase* get() const { return object_; }

 private:
  NMR::PLib3MFBase* object_ = nullptr;
};

/// Throws when `result` is an error of a call on `object`. @param name  the file
inline void require_3mf(LIB3MFRESULT result, NMR::PLib3MFBase* object, const std::string& name,
                        const char* expected) {
  if (result == 0) return;
  DWORD code = 0;
  LPCSTR text = nullptr;
  const bool known = object && NMR::lib3mf_getlasterror(object, &code, &text) == 0 && text && *text;
  std::string what = known ? text : fmt::format("error {:#x}", static_cast<unsigned>(result));
  for (char& c : what)
    if (c == '\n' || c == '\r') c = ' ';
  throw InputError(fmt::format("{}: 3MF: {}, expected {}", name, what, expected));
}

}  // namespace kreisel::core
