// Puts the file that make_tables wrote into the program as read-only bytes, without making the
// compiler parse millions of numbers. Who calls it: src/core/spectra_data.cpp, by symbol name.
// NEPHROID_TABLES_FILE is the path of the file; cmake/tables.cmake sets it.

__asm__(
    ".pushsection .rodata\n"
    ".balign 64\n"
    ".global nephroid_data_tables\n"
    ".hidden nephroid_data_tables\n"
    ".type nephroid_data_tables, @object\n"
    "nephroid_data_tables:\n"
    ".incbin \"" NEPHROID_TABLES_FILE
    "\"\n"
    ".size nephroid_data_tables, . - nephroid_data_tables\n"
    ".popsection\n");
