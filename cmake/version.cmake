# Writes OUTPUT with the version, the commit and the build, and leaves it alone if nothing has changed.
#
# The version counts up with every commit: "0.3.0+12.945a212c6e" is the 12th commit after the one that set 0.3.0 in
# CMakeLists.txt, with ".dirty" where the tree has changes that are not committed. It is a version for apt (a later
# commit is a newer package) and for Python (PEP 440). Of a shallow clone the number of commits is not known and is
# left out; without git the version is the number alone.
set(version "${VERSION}")
find_package(Git QUIET)

# git(RESULT argument...): its output; empty where it fails
function(git result)
  execute_process(COMMAND ${GIT_EXECUTABLE} ${ARGN} WORKING_DIRECTORY ${SOURCE_DIR}
    OUTPUT_VARIABLE output RESULT_VARIABLE status OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT status EQUAL 0)
    set(output "")
  endif()
  set(${result} "${output}" PARENT_SCOPE)
endfunction()

if(GIT_FOUND)
  git(commit describe --always --dirty=.dirty --exclude=* --abbrev=10)
  if(commit)
    set(count "")
    git(shallow rev-parse --is-shallow-repository)
    if(shallow STREQUAL "false")
      set(count 0) # until the change of the number is committed
      git(set_by log -1 --format=%H "-Sproject(stylobate VERSION ${VERSION} " -- CMakeLists.txt)
      if(set_by)
        git(count rev-list --count ${set_by}..HEAD)
      endif()
      string(APPEND count ".")
    endif()
    string(APPEND version "+${count}${commit}")
  endif()
endif()
set(text "#include \"studies/version.hpp\"\n\nconst char* stylobate::code_version()\n{\n    return \"${version}\";\n}\n")
string(APPEND text "\nconst char* stylobate::code_build()\n{\n    return \"${BUILD}\";\n}\n")
set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()
