# Writes HEADER with the commit of SOURCE; empty for sources without a history, as in a tarball.
execute_process(COMMAND git -C ${SOURCE} rev-parse --short=10 HEAD
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
file(WRITE ${HEADER} "#define TURBIDITE_COMMIT \"${commit}\"\n")
