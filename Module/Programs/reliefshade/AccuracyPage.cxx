// SPDX-License-Identifier: BSD-3-Clause
#include "AccuracyPage.h"

#include "AccuracyChart.h"

namespace
{

using namespace reliefshade;

const char* const Style = R"(
:root { color-scheme: light dark; --paper: #ffffff; --words: #1c1f23; --grid: #dfe3e8;
  --frame: #6b7280; --exact: #1a62a8; --steps: #b3480b; --mark: #111111; }
@media (prefers-color-scheme: dark) { :root { --paper: #16181c; --words: #e8eaed; --grid: #363b43;
  --frame: #9aa3ad; --exact: #74b4f5; --steps: #f59b62; --mark: #ffffff; } }
body { font: 16px/1.5 sans-serif; color: var(--words); background: var(--paper);
  max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }
svg { width: 100%; height: auto; font-family: sans-serif; }
svg .grid { stroke: var(--grid); } svg .frame { stroke: var(--frame); }
svg line.exact { stroke: var(--exact); } svg line.steps { stroke: var(--steps); }
svg line.mark { stroke: var(--mark); } svg .ring { fill: none; stroke: var(--mark); }
svg .dot.exact, svg text.exact { fill: var(--exact); }
svg .dot.steps, svg text.steps { fill: var(--steps); } svg text.words { fill: var(--words); }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { padding: 0.2rem 0.6rem; text-align: right; border-bottom: 1px solid var(--grid); }
th:first-child, td:first-child { text-align: left; }
.wide { overflow-x: auto; } .advice { font-size: 1.1rem; }
pre { overflow-x: auto; border: 1px solid var(--grid); padding: 0.6rem; }
)";

//------------------------------------------------------------------------------
std::string escape(const std::string& text)
{
  std::string escaped;
  for (const char c : text)
  {
    escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return escaped;
}

//------------------------------------------------------------------------------
std::string tableOf(const AccuracyTable& table)
{
  std::string text = "<div class=\"wide\"><table>\n<thead><tr><th>setting</th>"
                     "<th>ns a sample</th><th>seconds</th><th>99.9 % keep</th><th>largest</th>"
                     "<th>rms</th><th>samples</th></tr></thead>\n<tbody>\n";
  for (const AccuracyRow& row : table.Rows)
  {
    const std::string marks =
      std::string(row.Present ? " (yours)" : "") + (row.Recommended ? " (to take)" : "");
    text += std::string("<tr><td>") + (marks.empty() ? "" : "<strong>") + "<code>" + optionOf(row) +
      "</code>" + marks + (marks.empty() ? "" : "</strong>") + "</td><td>" +
      brief(row.Nanoseconds, 3) + "</td><td>" + brief(row.Seconds, 3) + "</td><td>" +
      brief(row.ErrorOf999, 2) + "</td><td>" + brief(row.LargestError, 2) + "</td><td>" +
      brief(row.RmsError, 2) + "</td><td>" + std::to_string(row.Samples) + "</td></tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
std::vector<std::string> notesOf(const AccuracyTable& table)
{
  return { "Errors are those of d, the mean over the lights, against the exact sum in double "
           "precision, ray by ray,",
    "at up to " + std::to_string(table.Compared) + " of " + std::to_string(table.Samples) +
      " samples, drawn by seed " + std::to_string(table.Seed) +
      ". Time: the least of several runs in turn." };
}

//------------------------------------------------------------------------------
std::string toPage(const AccuracyTable& table, const AccuracySubject& subject)
{
  const std::string input = escape(subject.Input);
  std::string text =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width\">\n<title>Accuracy of " +
    input + "</title>\n<style>" + Style +
    "</style>\n</head>\n<body>\n<h1>What accuracy costs: " + input + "</h1>\n<p>" +
    std::to_string(subject.Columns) + " x " + std::to_string(subject.Rows) +
    " samples, with the lights, material and environment of the scene below.</p>\n"
    "<p class=\"advice\"><strong>" +
    escape(adviceOf(table)) +
    "</strong> For numbers rather than pictures, as the layers Illumination and Thickness, take "
    "<code>--tolerance 0</code>.</p>\n" +
    toSvg(drawAccuracy(table, {})) + tableOf(table) + "<p>";
  for (const std::string& note : notesOf(table))
  {
    text += escape(note) + "\n";
  }
  return text +
    "It is that of shading to 8 bits on one thread of this machine, without reading, writing and "
    "what is prepared once, and differs a little from run to run. Single samples whose ray grazes "
    "the surface err by more than the tolerance: there rounding of the heights decides.</p>\n"
    "<p>Fixed steps are the thesis's Algorithm 1 as it was published: they know no attenuation, "
    "floor or tolerance, and put a sun on a sphere about the field. However many there are, they "
    "do "
    "not come to the exact d. Numbers of steps that would take long are left out.</p>\n"
    "<details><summary>The scene, as <code>--scene</code> reads it</summary>\n<pre>" +
    escape(subject.Scene) + "</pre></details>\n</body>\n</html>\n";
}

}
