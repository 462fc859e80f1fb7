// SPDX-License-Identifier: BSD-3-Clause
#ifndef AccuracyPage_h
#define AccuracyPage_h

#include "AccuracyTable.h"

#include <string>

namespace reliefshade
{

/// What a report is about, beside its numbers.
struct AccuracySubject
{
  std::string Input; ///< the file
  int Columns = 0;
  int Rows = 0;
  std::string Scene; ///< as the text of a scene's file
};

/// How and where it was measured, in sentences of less than a line each.
std::vector<std::string> notesOf(const AccuracyTable& table);

/// One page that needs no other file: advice, chart, table and scene, for light and dark screens.
std::string toPage(const AccuracyTable& table, const AccuracySubject& subject);

}

#endif
