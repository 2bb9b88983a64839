// outputs.hpp - whether what is asked for can be written.
#pragma once

#include <string>

namespace kreisel::core::apps {

/// Before minutes of work, not after: can the file be written? Empty and "-" (standard output) are fine.
/// @param option  as the user gave it, for the message
/// @throws InputError  its folder is none or refuses new files, or the name is taken by a folder, or by a
/// pipe
///                     or a device that takes nothing
void require_writable(const std::string& file, const char* option);

/// For what is read again once it is written. @throws InputError  a pipe, a device, or what is open already
void require_replaceable(const std::string& file, const char* option);

/// Why standard output took no more, by errno: one line of what, why and what was expected.
[[nodiscard]] std::string output_error();

/// Sends out what standard output holds back. @throws InputError  it takes no more, as a full disk does
void flush_output();

}  // namespace kreisel::core::apps
