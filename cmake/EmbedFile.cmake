# cmake -DINPUT=file -DOUTPUT=file.cpp -DNAME=variable -P EmbedFile.cmake: a file's bytes as a C++ array, so that the
# command needs nothing beside itself.
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
file(WRITE ${OUTPUT}.new "namespace gramap {\nextern const unsigned char ${NAME}[];\nextern const unsigned long ${NAME}_size;\nconst unsigned char ${NAME}[] = {${bytes}};\nconst unsigned long ${NAME}_size = sizeof ${NAME};\n}\n")
file(RENAME ${OUTPUT}.new ${OUTPUT})
