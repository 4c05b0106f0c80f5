# Stands for the tests written in C where cmocka is missing.
echo "1..0 # SKIP cmocka is missing (Debian package: libcmocka-dev)"
