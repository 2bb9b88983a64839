#include "solve/linear_algebra.hpp"

#include <dlfcn.h>

#include <IpBlas.hpp>
#include <cstdio>
#include <string_view>
#include <vector>

namespace kreisel::core {
namespace {

void set_blas_threads(int count) {
  using SetThreads = void (*)(int);
  if (const auto set = reinterpret_cast<SetThreads>(::dlsym(RTLD_DEFAULT, "openblas_set_num_threads")))
    set(count);
}

}  // namespace

MemoryJournal::MemoryJournal() : Journal("memory", Ipopt::J_NONE) {
  SetPrintLevel(Ipopt::J_LINEAR_ALGEBRA, Ipopt::J_ERROR);
}

void MemoryJournal::PrintImpl(Ipopt::EJournalCategory, Ipopt::EJournalLevel, const char* text) {
  // "MUMPS returned INFO(1) =-13 - out of memory when ...", "MUMPS was not able to obtain enough memory."
  if (std::string_view(text).find("memory") != std::string_view::npos) ran_out_ = true;
}

void MemoryJournal::PrintfImpl(Ipopt::EJournalCategory category, Ipopt::EJournalLevel level,
                               const char* format, va_list arguments) {
  char text[512];
  std::vsnprintf(text, sizeof text, format, arguments);
  PrintImpl(category, level, text);
}

SerialBlas::SerialBlas() {
  using GetThreads = int (*)();
  if (const auto get = reinterpret_cast<GetThreads>(::dlsym(RTLD_DEFAULT, "openblas_get_num_threads"))) {
    threads_ = get();
    set_blas_threads(1);
  }
}

SerialBlas::~SerialBlas() {
  if (threads_ > 0) set_blas_threads(threads_);
}

void reserve_blas_buffers() {
  set_blas_threads(1);
  constexpr int n = 128;  // small products do without a buffer
  const std::vector<double> a(n * n, 1.0);
  std::vector<double> c(n * n);
  Ipopt::IpBlasDgemm(false, false, n, n, n, 1.0, a.data(), n, a.data(), n, 0.0, c.data(), n);
}

}  // namespace kreisel::core
