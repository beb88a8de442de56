# Writes OUTPUT: the style and the script of the pages (the files STYLE and SCRIPTS, in this order) as C++ strings, and
# the table that scripts/space.sh has written into the page EVIDENCE.
function(literal_of out)
  set(parts "")
  foreach(file ${ARGN})
    file(READ ${file} text)
    if(text MATCHES "<!--|</?(script|style)")
      message(FATAL_ERROR "${file} contains ${CMAKE_MATCH_0}, which would end the element that it stands in")
    endif()
    if(file MATCHES "\\.js$") # comments of whole lines, and indents, stay in the source
      string(REGEX REPLACE "\n *(//|/\\*\\*|\\* |\\*/)[^\n]*" "" text "\n${text}")
      string(REGEX REPLACE "\n +" "\n" text "${text}")
    endif()
    string(APPEND parts "R\"embedded(${text})embedded\"\n") # one literal a file: compilers limit their length
  endforeach()
  set(${out} "${parts}" PARENT_SCOPE)
endfunction()

string(REPLACE "|" ";" scripts "${SCRIPTS}")
literal_of(style ${STYLE})
literal_of(script ${scripts})
file(READ ${EVIDENCE} page)
if(NOT page MATCHES "<!-- scripts/space.sh writes what follows -->\n(.*)\n<!-- end of what scripts/space.sh writes -->")
  message(FATAL_ERROR "${EVIDENCE} has lost the marks of scripts/space.sh")
endif()
set(evidence "R\"embedded(${CMAKE_MATCH_1})embedded\"")
file(WRITE ${OUTPUT} "#include \"studies/report/html.hpp\"

std::string_view stylobate::page_style()
{
    return ${style};
}

std::string_view stylobate::page_script()
{
    return ${script};
}

std::string_view stylobate::space_evidence()
{
    return ${evidence};
}
")
