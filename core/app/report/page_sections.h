// SPDX-License-Identifier: BSD-2-Clause
// These functions make the sections of a study's report, in page order. The opening is what the
// first screen shows; each other section is a <details> that the reader opens.
#pragma once

#include <string>

#include "core/app/analysis/analysis.h"
#include "core/app/report/template.h"

namespace exphoton::study {

Html Opening(const std::string& folder, const Results& results, const Analysis& analysis);
Html FrontSection(const Results& results, const Analysis& analysis);
Html PictureSection(const std::string& folder, const Results& results, const Analysis& analysis);
Html PriceSection(const Results& results, const Analysis& analysis);
Html PredictionSection(const Results& results, const Analysis& analysis);
Html BudgetSection(const Results& results);
Html CertificateSection(const Results& results, const Analysis& analysis);
Html DoublingSection(const Results& results, const Analysis& analysis);
Html BarSection(const Results& results, const Analysis& analysis);
Html MapSection(const std::string& folder, const Results& results);
Html SettingSection(const Results& results, const Analysis& analysis);
Html MachineSection(const Results& results, const Analysis& analysis);

}  // namespace exphoton::study
