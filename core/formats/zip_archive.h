// Several files as one: ZIP (PKWARE's APPNOTE 6.3), stored as they are, since pictures are packed already. The only
// user of minizip.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace awan {

// The same files make the same bytes: all are dated 1980-01-01, where the format's time begins.
class ZipArchive {
  public:
    static Result<ZipArchive> begin();
    ZipArchive(ZipArchive&& other) noexcept;
    ZipArchive& operator=(ZipArchive&& other) noexcept;
    ~ZipArchive();

    // name: ASCII, with / between folders, not one that is in it already. Not more than 4 GiB each.
    Status add(const std::string& name, std::string_view bytes);
    // So far, without the list at its end: about 80 bytes a file.
    std::size_t bytes() const;
    // The archive, once all files were added.
    Result<std::string> end();

  private:
    struct State;
    explicit ZipArchive(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace awan
