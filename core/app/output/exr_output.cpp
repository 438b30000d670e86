// SPDX-License-Identifier: BSD-2-Clause
// WarnOfClamping names the option that keeps the values.
#include "core/app/output/exr_output.h"

#include "core/base/log.h"
#include "core/imaging/files/exr.h"

namespace exphoton::cli {

void WarnOfClamping(const ExrWriteReport& report, Log& log) {
  const long long count = report.clampedToHalf;
  if (count == 0) return;
  log.Warning(std::to_string(count) +
              (count == 1
                   ? " value above 65504 was written as 65504; --float stores it as it is"
                   : " values above 65504 were written as 65504; --float stores them as they are"));
}

void WriteExrPicture(const std::string& path, const Image& image, bool asHalf, Log& log) {
  if (!image.isFromSrgb || !image.hasStraightAlpha)
    return WarnOfClamping(WriteExr(path, image, asHalf), log);
  Image premultiplied = image;
  PremultiplyAlpha(&premultiplied);
  WarnOfClamping(WriteExr(path, premultiplied, asHalf), log);
}

}  // namespace exphoton::cli
