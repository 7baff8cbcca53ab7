# Pictures as tests of CTest: include(picture_tests.cmake), then add_picture_test(NAME DEVICE PROGRAM…).
find_program(ETALON etalon REQUIRED)

# PROGRAM draws golden/NAME.draws into NAME.png (its last two arguments); `etalon diff` judges that by what DEVICE may do.
function(add_picture_test name device)
  set(golden "${CMAKE_CURRENT_SOURCE_DIR}/golden")
  set(waivers)
  if(EXISTS "${golden}/${name}.waivers.json")
    set(waivers --waivers "${golden}/${name}.waivers.json")
  endif()
  add_test(NAME draw_${name} COMMAND ${ARGN} "${golden}/${name}.draws" ${name}.png)
  add_test(NAME picture_${name} COMMAND "${ETALON}" diff "${golden}/${name}.exr" ${name}.png --device ${device} ${waivers}
                                        --junit ${name}.xml --html ${name}.html)
  set_tests_properties(draw_${name} PROPERTIES FIXTURES_SETUP ${name})
  set_tests_properties(picture_${name} PROPERTIES FIXTURES_REQUIRED ${name})
endfunction()
