// linear_algebra.hpp - what Ipopt's linear algebra does when memory runs out.
#pragma once

#include <IpIpoptApplication.hpp>
#include <string>

namespace kreisel::core {

/// Hears the complaints of Ipopt's linear solver, which otherwise end in "restoration failed".
class MemoryJournal final : public Ipopt::Journal {
 public:
  MemoryJournal();
  /// Whether the linear solver said that memory was short.
  [[nodiscard]] bool ran_out() const { return ran_out_; }

 protected:
  void PrintImpl(Ipopt::EJournalCategory category, Ipopt::EJournalLevel level, const char* text) override;
  void PrintfImpl(Ipopt::EJournalCategory category, Ipopt::EJournalLevel level, const char* format,
                  va_list arguments) override;
  void FlushBufferImpl() override {}

 private:
  bool ran_out_ = false;
};

/// While one lives, OpenBLAS has one thread; another library of that interface is as it was.
class SerialBlas {
 public:
  SerialBlas();
  ~SerialBlas();
  SerialBlas(const SerialBlas&) = delete;
  SerialBlas& operator=(const SerialBlas&) = delete;

 private:
  int threads_ = 0;  ///< that it had; 0: not known
};

/// Memory that reserve_blas_buffers() and the heaps of threads take before MUMPS takes any, bytes.
inline constexpr double blas_bytes = 0x1p28;

/// For a process whose address space is limited. OpenBLAS asks for buffers of 128 MiB, one a thread, and
/// where it is denied one asks again for ever: so from now on it has one thread, whose buffer it takes here.
/// Call it while there are blas_bytes; with another library of that interface nothing comes of it.
void reserve_blas_buffers();

}  // namespace kreisel::core
