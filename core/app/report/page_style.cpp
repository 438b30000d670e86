// SPDX-License-Identifier: BSD-2-Clause
// PageStyle returns the style sheet of the report, which the build embeds from page.css.
#include "core/app/report/page_css.h"
#include "core/app/report/page_sections.h"

namespace exphoton::study {

std::string PageStyle() { return kPageCss; }

}  // namespace exphoton::study
