# The page of batten report, one file that the program puts a sweep's numbers into. Its third-party
# code (ECharts, three.js) and the bundler (esbuild) come from the package registry that npm is set up
# for, once: what is in the modules' folder is used again without a network. A build without npm, or
# whose npm reaches no registry, has no page and succeeds; `batten report` then says so.
set(BATTEN_REPORT_MODULES "${PROJECT_BINARY_DIR}/report" CACHE PATH "Where npm keeps the page's modules")
set(report_found OFF)
set(report_problem "")
set(report_folder "${CMAKE_CURRENT_LIST_DIR}")
if(NOT BATTEN_REPORT STREQUAL "OFF")
	find_program(BATTEN_NODE NAMES node nodejs)
	find_program(BATTEN_NPM npm)
	file(SHA256 "${report_folder}/package-lock.json" report_lock)
	set(report_stamp "${BATTEN_REPORT_MODULES}/complete")
	set(report_has "")
	if(EXISTS "${report_stamp}")
		file(READ "${report_stamp}" report_has)
	endif()
	if(NOT BATTEN_NODE)
		set(report_problem "node is missing (apt-get install nodejs npm)")
	elseif(report_has STREQUAL report_lock)
		set(report_found ON)
	elseif(NOT BATTEN_NPM)
		set(report_problem "npm is missing (apt-get install npm)")
	else()
		message(STATUS "Fetching the modules of the report's page by npm")
		file(REMOVE "${report_stamp}")
		file(MAKE_DIRECTORY "${BATTEN_REPORT_MODULES}")
		file(COPY "${report_folder}/package.json" "${report_folder}/package-lock.json"
			DESTINATION "${BATTEN_REPORT_MODULES}")
		# The lock file has every package's checksum; no package runs a script.
		execute_process(
			COMMAND "${BATTEN_NPM}" ci --ignore-scripts --no-audit --no-fund --no-update-notifier
				--fetch-retries=1 --fetch-timeout=30000 --loglevel=error
			WORKING_DIRECTORY "${BATTEN_REPORT_MODULES}" TIMEOUT 180
			RESULT_VARIABLE result OUTPUT_VARIABLE report_log ERROR_VARIABLE report_log)
		if(result EQUAL 0)
			file(WRITE "${report_stamp}" "${report_lock}")
			set(report_found ON)
		else()
			set(report_problem "npm could not fetch its modules")
			file(WRITE "${BATTEN_REPORT_MODULES}/npm.log" "${report_log}")
		endif()
	endif()
	if(NOT report_found AND BATTEN_REPORT STREQUAL "ON")
		message(FATAL_ERROR "BATTEN_REPORT=ON: ${report_problem}\n${report_log}")
	endif()
endif()

if(report_found)
	file(GLOB report_sources CONFIGURE_DEPENDS "${report_folder}/*.js" "${report_folder}/*.css"
		"${report_folder}/*.html")
	set(report_page "${PROJECT_BINARY_DIR}/batten_report.html")
	add_custom_command(
		OUTPUT "${report_page}"
		COMMAND "${BATTEN_NODE}" "${report_folder}/build.mjs" "${BATTEN_REPORT_MODULES}/node_modules"
			"${report_page}"
		DEPENDS ${report_sources} "${report_folder}/build.mjs" "${report_stamp}"
		COMMENT "Bundling the report's page" VERBATIM)
	add_custom_target(batten_report_page ALL DEPENDS "${report_page}")
	install(FILES "${report_page}" DESTINATION "${CMAKE_INSTALL_LIBDIR}/batten")
elseif(BATTEN_REPORT STREQUAL "OFF")
	message(STATUS "Without the page of batten report")
else()
	# Not an error, but to be seen where only warnings are.
	message(NOTICE "Without the page of batten report: ${report_problem}")
endif()
