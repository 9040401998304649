// What is fuzzed: functions that take any bytes at all, and the laws that hold whatever the bytes are. libFuzzer looks
// for bytes that break one (run.sh); fuzz_test.cpp replays what it found, in every build.
#pragma once

#include <string_view>

namespace awan::fuzz {

// Each ends the process when a law is broken.

// A law. Broken: says so and aborts, as a fuzzer wants it.
void require(bool holds, const char* law);

// targets_scene.cpp
void fuzz_json(std::string_view bytes);
void fuzz_awn(std::string_view bytes);
void fuzz_ply(std::string_view bytes);
void fuzz_csv(std::string_view bytes);
// By their look, and packed or not: what the command line does with a file.
void fuzz_file(std::string_view bytes);

// targets_http.cpp
// The body of a form; its first line is the Content-Type.
void fuzz_form(std::string_view bytes);
// A head, alone and in pieces.
void fuzz_head(std::string_view bytes);
// targets_request.cpp
// Requests one after the other, as a connection brings them, to their answers. Nothing is rendered: a renderer of the
// tests gives white pictures.
void fuzz_request(std::string_view bytes);

}  // namespace awan::fuzz
