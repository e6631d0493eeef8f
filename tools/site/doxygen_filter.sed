# Doxygen's view of a header (sed -E). Lines keep their numbers.
# What a shared library shows is no matter to readers.
s/CAIRN_([A-Z]+_EXPORT|HIDDEN) //g
# Of defaulted and deleted members it says all that there is to say, so that nobody has to write it.
s|= default;$|&  ///< Made by the compiler, member by member.|
s|= delete;$|&  ///< There is none.|
# A comment behind several names is about each of them; Doxygen gives it to the last alone.
:again
s#(^ *|\*/ )(((inline|static|constexpr|const) )*[A-Za-z_][A-Za-z0-9_:]*) ([A-Za-z_][^,;(){}<>]*(\{\})?), ([A-Za-z_][^;()<>]*); +///<(.*)$#\1\2 \5; /**<\8 */ \2 \7;  ///<\8#
t again
