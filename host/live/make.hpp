// make.hpp - the part of a question, by the pipeline of `design`: its files and its report.
#pragma once

#include <memory>

#include "live/message.hpp"
#include "live/part_fields.hpp"
#include "session/session.hpp"

namespace kreisel::core::live {

/// Sends each step as it begins, each file, and at the end what was made. The files lie in a folder of its
/// own while they are made, and nowhere afterwards.
/// @throws InputError, Interrupted, MemoryError  nothing is sent then but steps
void make(const nlohmann::json& id, Session& session, PartSpec spec, const Send& send, std::stop_token stop);

}  // namespace kreisel::core::live
