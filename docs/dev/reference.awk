# What Doxygen sees of a public header (INPUT_FILTER). The folder that a header is in is its group. The lines "Cost:"
# and "Based on:" are sections. Lines keep their numbers, which warnings name.
FNR == 1 { count = split(FILENAME, parts, "/"); room = parts[count - 1] }
opened && opened == FNR - 1 { $0 = "@{ */" } # the blank line below the namespace
$0 == "namespace vdbcage {" { opened = FNR; $0 = $0 " /** \\addtogroup " room }
$0 == "} // namespace vdbcage" { $0 = "/** @} */ }" }
{ sub(/\/\/\/ Cost:/, "/// \\cost"); sub(/\/\/\/ Based on:/, "/// \\basedon"); print }
