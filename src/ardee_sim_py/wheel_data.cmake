# SPDX-License-Identifier: MIT
# What a wheel holds besides modules: the packages' worlds, robots, sensors, and the models that the build makes.
set(src ${CMAKE_CURRENT_SOURCE_DIR}/..)
set(made ${CMAKE_CURRENT_BINARY_DIR}/share)
set(share ardee_common/share)

# By Debian's Python, as in the workspace, so that both have the same plants to the last bit
set(generate ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1
  PYTHONPATH=${src}/ardee_common/src:${src}/ardee_models/src:${src}/ardee_world/src:${src}/../pydeps /usr/bin/python3)
file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${src}/ardee_common/src/*.py ${src}/ardee_models/src/*.py
  ${src}/ardee_models/config/*.yaml ${src}/ardee_world/src/*.py ${src}/ardee_world/fields/* ${src}/ardee_world/terrains/*)
add_custom_command(
  OUTPUT ${made}/models.stamp
  COMMAND ${generate} -m ardee_models.build --share ${made}/ardee_models --static ${src}/ardee_models/models
  COMMAND ${generate} -m ardee_world.build --source ${src}/ardee_world --share ${made}/ardee_world
    --model-path ${made}/ardee_models/models
  COMMAND ${CMAKE_COMMAND} -E touch ${made}/models.stamp
  DEPENDS ${sources}
  COMMENT "Generating crops, terrains and fields"
  VERBATIM)
add_custom_target(wheel_data ALL DEPENDS ${made}/models.stamp)

install(DIRECTORY ${made}/ DESTINATION ${share} PATTERN *.stamp EXCLUDE)
foreach(package ardee_models ardee_navigation ardee_sensors ardee_world terrasentia_description)
  foreach(folder config fields media meshes robots terrains urdf worlds)
    if(IS_DIRECTORY ${src}/${package}/${folder})
      install(DIRECTORY ${src}/${package}/${folder} DESTINATION ${share}/${package})
    endif()
  endforeach()
  install(FILES ${src}/${package}/package.xml DESTINATION ${share}/${package})
endforeach()
install(DIRECTORY ${src}/ardee_sensors/models DESTINATION ${share}/ardee_sensors)
