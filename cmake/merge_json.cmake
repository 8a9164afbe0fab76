# SPDX-FileCopyrightText: 2026 The vantage authors
# SPDX-License-Identifier: MIT

# cmake -DKEY=benchmarks -DPARTS="DIR/*.json" -DOUT=all.json -P merge_json.cmake
# Writes the first of PARTS with, as its array KEY, the arrays KEY of all PARTS in a row.
file(GLOB parts "${PARTS}")
foreach(part IN LISTS parts)
  file(READ "${part}" document)
  if(NOT DEFINED merged)
    set(merged "${document}")
    set(items "")
    set(separator "")
  endif()
  string(JSON array GET "${document}" ${KEY})
  string(REGEX REPLACE "^\\[(.*)\\]$" "\\1" array "${array}")
  string(STRIP "${array}" array)
  if(NOT array STREQUAL "")
    string(APPEND items "${separator}${array}")
    set(separator ",")
  endif()
endforeach()
string(JSON merged SET "${merged}" ${KEY} "[${items}]")
file(WRITE "${OUT}" "${merged}\n")
