# Turns one kernel into a C array and into one plain file.
#
#   cmake -DINPUT=kernels/NAME.cl -DOUTPUT=FOLDER/NAME.cl.c -P embed.cmake
#
# writes OUTPUT (const char kernel_source_NAME[], NUL-terminated) and, beside it, NAME.cl. A line
# #include "shared/X.h", in a header of shared/ also #include "X.h", is replaced by the text of
# kernels/shared/X.h at its first occurrence and by an empty line after that; in a header of shared/,
# which C reads too, #include <X.h> stays as it is. Any other #include is an error. #line directives
# make a driver's build log name the original file and line.
cmake_minimum_required(VERSION 3.25)

get_filename_component(folder "${INPUT}" DIRECTORY)
get_filename_component(name "${INPUT}" NAME_WE)
set_property(GLOBAL PROPERTY included "")

# Appends the resolved text of folder/file to the property "text".
function(append_file file)
	file(READ "${folder}/${file}" rest)
	if(rest MATCHES "[^\t\n -~]")
		message(FATAL_ERROR "kernels/${file}: a character that is not plain ASCII")
	endif()
	if(NOT rest MATCHES "\n$")
		string(APPEND rest "\n")
	endif()
	set_property(GLOBAL APPEND_STRING PROPERTY text "#line 1 \"${file}\"\n")
	set(line 1)
	while(rest MATCHES "(^|\n)[ \t]*#[ \t]*include[^\n]*\n")
		# CMake's regular expressions know no line anchors: a match that does not begin the text
		# starts with the newline before it.
		set(directive "${CMAKE_MATCH_0}")
		string(FIND "${rest}" "${directive}" begin)
		if(directive MATCHES "^\n")
			math(EXPR begin "${begin} + 1")
			string(SUBSTRING "${directive}" 1 -1 directive)
		endif()
		string(LENGTH "${directive}" length)
		string(SUBSTRING "${rest}" 0 ${begin} before)
		math(EXPR begin "${begin} + ${length}")
		string(SUBSTRING "${rest}" ${begin} -1 rest)
		string(REGEX MATCHALL "\n" newlines "${before}")
		list(LENGTH newlines count)
		math(EXPR line "${line} + ${count}")

		if(directive MATCHES "^[ \t]*#[ \t]*include[ \t]+\"shared/([A-Za-z0-9_]+\\.h)\"[ \t]*\n$")
			set(header "shared/${CMAKE_MATCH_1}")
		elseif(file MATCHES "^shared/" AND
		       directive MATCHES "^[ \t]*#[ \t]*include[ \t]+\"([A-Za-z0-9_]+\\.h)\"[ \t]*\n$")
			set(header "shared/${CMAKE_MATCH_1}")
		elseif(file MATCHES "^shared/" AND directive MATCHES "<[a-z]+\\.h>")
			set_property(GLOBAL APPEND_STRING PROPERTY text "${before}${directive}")
			math(EXPR line "${line} + 1")
			continue()
		else()
			message(FATAL_ERROR
				"kernels/${file}:${line}: a kernel includes only \"shared/NAME.h\", found ${directive}")
		endif()
		if(NOT EXISTS "${folder}/${header}")
			message(FATAL_ERROR "kernels/${file}:${line}: no such file: kernels/${header}")
		endif()

		set_property(GLOBAL APPEND_STRING PROPERTY text "${before}")
		get_property(included GLOBAL PROPERTY included)
		if(header IN_LIST included)
			set_property(GLOBAL APPEND_STRING PROPERTY text "\n")
		else()
			set_property(GLOBAL APPEND PROPERTY included "${header}")
			append_file("${header}")
			math(EXPR next "${line} + 1")
			set_property(GLOBAL APPEND_STRING PROPERTY text "#line ${next} \"${file}\"\n")
		endif()
		math(EXPR line "${line} + 1")
	endwhile()
	set_property(GLOBAL APPEND_STRING PROPERTY text "${rest}")
endfunction()

append_file("${name}.cl")
get_property(text GLOBAL PROPERTY text)

get_filename_component(output_folder "${OUTPUT}" DIRECTORY)
set(plain "${output_folder}/${name}.cl")
file(WRITE "${plain}" "${text}")
file(READ "${plain}" bytes HEX)
string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
string(REPEAT "0x..," 16 sixteen)
string(REGEX REPLACE "${sixteen}" "\\0\n" bytes "${bytes}")
file(WRITE "${OUTPUT}"
"/* kernels/${name}.cl, its includes resolved; written by kernels/embed.cmake. */
#include \"kernels/kernel_sources.h\"

const char kernel_source_${name}[] = {
${bytes}0x00
};
")
